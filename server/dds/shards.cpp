#include "dds/shards.hpp"

#include <xxhash.h>

#include <tuple>

namespace camdir::dds {
namespace {

// Greater names decide between equal hashes.
auto weight(const std::string& shard, std::string_view match_id) {
    const XXH64_hash_t seed = XXH3_64bits(shard.data(), shard.size());
    return std::tuple(XXH3_64bits_withSeed(match_id.data(), match_id.size(), seed), std::string_view(shard));
}

}  // namespace

bool Shards::serves(std::string_view match_id) const {
    if (all_.empty()) return true;
    const auto first =
        std::ranges::max_element(all_, {}, [&](const std::string& shard) { return weight(shard, match_id); });
    return *first == own_;
}

}  // namespace camdir::dds
