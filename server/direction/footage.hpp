// What a director has to choose from: the players and the cameras that follow them, in beats of 0.1 s.
#pragma once

#include <bitset>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/geometry.hpp"

namespace camdir::direction {

// Beats are the time of this module. Beat b is [b, b + 1) * 0.1 s of the match; a cut at beat b shows the new
// camera from its first frame on.
using Beat = std::int64_t;
inline constexpr double beat_s = 0.1;
[[nodiscard]] Beat beat_of(double seconds);  // that the time is in

// Players and rushes are named by their place in the match's lists.
inline constexpr std::size_t max_players = 256;
using Index = std::uint16_t;
inline constexpr Index nobody = 0xffff;
using PlayerSet = std::bitset<max_players>;

// A player over one beat, from its first frame; all that is not finite is replaced by zeros.
struct PlayerState {
    Vec3f eye = Vec3f::Zero();
    Vec3f facing = Vec3f::UnitX();  // length 1
    float speed = 0.0F;             // map units a second
    std::uint8_t team = 0;          // 0: everybody's enemy
    bool present = false;
    bool alive = false;
    PlayerSet sees;  // whose eye there is a free line of sight to
};

// A rush over one beat.
struct Take {
    Vec3f position = Vec3f::Zero();  // of the camera, in the first frame
    PlayerSet shown;                 // in the picture and not hidden, in every frame of the beat
    bool cut = false;                // the camera itself jumps: its player respawned or was teleported
};

// Beats are appended as they become known, and may be forgotten. What is known at a beat ends at `beats()`.
class Footage {
  public:
    // `subjects[r]`: the player whom rush r follows. At most max_players players.
    Footage(std::size_t players, std::vector<Index> subjects);

    // Of every player, and of every rush.
    void append(std::span<const PlayerState> players, std::span<const Take> takes);
    // One more, who was absent so far, and the rush that follows them. Precondition: fewer than max_players.
    void add_player();
    // Those before `beat`, sooner or later.
    void forget_before(Beat beat);

    [[nodiscard]] std::size_t players() const { return players_; }
    [[nodiscard]] std::size_t rushes() const { return subjects_.size(); }
    [[nodiscard]] Index subject(std::size_t rush) const { return subjects_[rush]; }
    [[nodiscard]] Beat beats() const { return beats_; }
    [[nodiscard]] Beat first() const { return first_; }  // that is not forgotten

    // Preconditions: first() <= beat < beats().
    [[nodiscard]] const PlayerState& player(Beat beat, std::size_t player) const {
        return states_[row(beat) * players_ + player];
    }
    [[nodiscard]] const Take& take(Beat beat, std::size_t rush) const {
        return takes_[row(beat) * subjects_.size() + rush];
    }
    [[nodiscard]] std::span<const PlayerState> players_at(Beat beat) const {
        return std::span(states_).subspan(row(beat) * players_, players_);
    }
    [[nodiscard]] std::span<const Take> takes_at(Beat beat) const {
        return std::span(takes_).subspan(row(beat) * subjects_.size(), subjects_.size());
    }
    [[nodiscard]] const std::vector<Index>& subjects() const { return subjects_; }

  private:
    [[nodiscard]] std::size_t row(Beat beat) const { return static_cast<std::size_t>(beat - first_); }

    std::size_t players_;
    std::vector<Index> subjects_;
    Beat first_ = 0;
    Beat beats_ = 0;
    std::vector<PlayerState> states_;  // of the first beat, of the next one, ...
    std::vector<Take> takes_;
};

}  // namespace camdir::direction
