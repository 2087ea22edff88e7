#include "direction/footage.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace camdir::direction {
namespace {

constexpr Beat worth_moving = 64;

// Rows of `before` values get another column.
template <class T>
void widen(std::vector<T>& values, std::size_t before) {
    if (before == 0) return;
    std::vector<T> wider;
    wider.reserve(values.size() / before * (before + 1));
    for (auto row = values.begin(); row != values.end(); row += static_cast<std::ptrdiff_t>(before)) {
        wider.insert(wider.end(), row, row + static_cast<std::ptrdiff_t>(before));
        wider.emplace_back();
    }
    values = std::move(wider);
}

}  // namespace

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

void Footage::add_player() {
    assert(players_ < max_players);
    const auto beats = static_cast<std::size_t>(beats_ - first_);
    if (players_ == 0) states_.resize(beats);
    if (subjects_.empty()) takes_.resize(beats);
    widen(states_, players_);
    widen(takes_, subjects_.size());
    subjects_.push_back(static_cast<Index>(players_++));
}

void Footage::forget_before(Beat beat) {
    if (beat - first_ < worth_moving) return;
    const auto rows = static_cast<std::ptrdiff_t>(row(std::min(beat, beats_)));
    states_.erase(states_.begin(), states_.begin() + rows * static_cast<std::ptrdiff_t>(players_));
    takes_.erase(takes_.begin(), takes_.begin() + rows * static_cast<std::ptrdiff_t>(subjects_.size()));
    first_ += rows;
}

}  // namespace camdir::direction
