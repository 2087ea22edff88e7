// Matches that are not served: for want of room, or because another shard serves them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <list>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "dds/ownership.hpp"

namespace camdir::dds {

// Keeps their newest descriptions, in the order of arrival. One thread at a time.
class WaitingMatches {
  public:
    // Without bounds: of what others bound.
    WaitingMatches() = default;
    // At most so many, and so many of one participant.
    WaitingMatches(std::size_t most, std::size_t most_of_sender)
        : most_(most), most_of_sender_(most_of_sender) {}

    // False where there is no room for it.
    [[nodiscard]] bool keep(Ownership::Claim claim);
    [[nodiscard]] bool has(const std::string& match_id, WriterHandle writer) const;
    // This writer has withdrawn its description.
    void remove(const std::string& match_id, WriterHandle writer);
    // Those whose writers are not among these (ascending) are gone.
    void retain(std::span<const WriterHandle> matched);
    // Takes the first that is wanted.
    template <class IsWanted>
    [[nodiscard]] std::optional<Ownership::Claim> take(const IsWanted& is_wanted) {
        const auto found = std::ranges::find_if(claims_, is_wanted);
        if (found == claims_.end()) return std::nullopt;
        std::optional<Ownership::Claim> claim = std::move(*found);
        claims_.erase(found);
        return claim;
    }

  private:
    std::size_t most_ = std::numeric_limits<std::size_t>::max();
    std::size_t most_of_sender_ = most_;
    std::list<Ownership::Claim> claims_;
};

}  // namespace camdir::dds
