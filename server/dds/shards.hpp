// Which of the directors that share a domain's matches serve a match.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace camdir::dds {

// Every match has one shard, by rendezvous hashing (Thaler, Ravishankar 1998): one more shard takes its part
// of the matches, equally from all others, and no match moves between these.
class Shards {
  public:
    // One shard, which serves every match.
    Shards() = default;
    // `own` serves nothing where it is not among `all`.
    Shards(std::string own, std::vector<std::string> all) : own_(std::move(own)), all_(std::move(all)) {}

    [[nodiscard]] bool serves(std::string_view match_id) const { return home_of(match_id) == own(); }
    // Numbers of shards, the same in all processes; 0 where there are none.
    [[nodiscard]] std::uint64_t own() const { return all_.empty() ? 0 : number_of(own_); }
    [[nodiscard]] std::uint64_t home_of(std::string_view match_id) const;
    [[nodiscard]] std::size_t count() const { return std::max<std::size_t>(all_.size(), 1); }

  private:
    [[nodiscard]] static std::uint64_t number_of(const std::string& shard);

    std::string own_;
    std::vector<std::string> all_;
};

}  // namespace camdir::dds
