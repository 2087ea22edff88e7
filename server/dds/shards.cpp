#include "dds/shards.hpp"

#include <xxhash.h>

#include <tuple>

namespace camdir::dds {

std::uint64_t Shards::number_of(const std::string& shard) {
    return std::max<std::uint64_t>(XXH3_64bits(shard.data(), shard.size()), 1);
}

std::uint64_t Shards::home_of(std::string_view match_id) const {
    std::uint64_t home = 0;
    std::uint64_t most = 0;
    for (const std::string& shard : all_) {
        const std::uint64_t number = number_of(shard);
        const std::uint64_t weight = XXH3_64bits_withSeed(match_id.data(), match_id.size(), number);
        if (std::tuple(weight, number) > std::tuple(most, home))
            std::tie(most, home) = std::tuple(weight, number);
    }
    return home;
}

}  // namespace camdir::dds
