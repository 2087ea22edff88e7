#include "direction/footage.hpp"

#include <cassert>
#include <cmath>
#include <utility>

namespace camdir::direction {

Beat beat_of(double seconds) {
    constexpr double rounding = 1e-6;  // of times that are multiples of a beat
    return static_cast<Beat>(std::floor(seconds / beat_s + rounding));
}

Footage::Footage(std::size_t players, std::vector<Index> subjects)
    : players_(players), subjects_(std::move(subjects)) {
    assert(players_ <= max_players);
}

void Footage::append(std::span<const PlayerState> players, std::span<const Take> takes) {
    assert(players.size() == players_ && takes.size() == subjects_.size());
    states_.insert(states_.end(), players.begin(), players.end());
    takes_.insert(takes_.end(), takes.begin(), takes.end());
    ++beats_;
}

}  // namespace camdir::direction
