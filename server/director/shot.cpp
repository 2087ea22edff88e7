#include "director/shot.hpp"

#include <xxhash.h>

#include <cstring>

namespace camdir::director {

std::uint32_t camera_id_of(const ShotKey& key) {
    std::string bytes;
    const auto append = [&](std::uint32_t number) {
        for (int shift = 0; shift < 32; shift += 8)
            bytes += static_cast<char>(number >> shift & 0xffU);
    };
    append(key.target);
    append(static_cast<std::uint32_t>(key.group.size()));
    for (const std::uint32_t player : key.group)
        append(player);
    bytes += key.profile + '\0' + key.overrides;
    const auto id = static_cast<std::uint32_t>(XXH3_64bits(bytes.data(), bytes.size()));
    return id == 0 ? 1 : id;
}

}  // namespace camdir::director
