// What a director has to choose from: the players and the cameras that show them, in beats of 0.1 s.
#pragma once

#include <algorithm>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <deque>
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

[[nodiscard]] bool enemies(std::uint8_t team, std::uint8_t other);
[[nodiscard]] bool enemies(const PlayerState& a, const PlayerState& b);

// Two living enemies, one of whom sees the other.
struct Meeting {
    Index a = nobody;
    Index b = nobody;       // > a
    float distance = 0.0F;  // of their eyes, map units
    float cosine = -1.0F;   // of the angle at which one of them looks past the other: the smaller angle
};

// A rush over one beat.
struct Take {
    Vec3f position = Vec3f::Zero();  // of the camera, in the first frame
    PlayerSet shown;                 // in the picture and not hidden, in every frame of the beat
    PlayerSet framed;                // in the picture in the first frame, hidden or not
    bool cut = false;                // the camera itself jumps
    bool late_cut = false;           // it does after the first frame: a cut at the beat is another one
    // Whom the picture is of: of a rush that follows a player always they; of a fixed one nobody where it has
    // nobody to show.
    Index subject = nobody;

    void jump(bool in_first_frame) {
        cut = true;
        late_cut = late_cut || !in_first_frame;
    }
    void forget_jumps() { cut = late_cut = false; }
};

// Of a picture that is made for nobody: the nearest of those shown who live and meet an enemy, or, where
// nobody does, the nearest who lives.
[[nodiscard]] Index subject_in(const Take& take, std::span<const PlayerState> players);

// Beats are appended as they become known, and may be forgotten. What is known at a beat ends at `beats()`.
class Footage {
  public:
    // `followed[r]`: the player whom rush r follows, or nobody: it is fixed. At most max_players players.
    Footage(std::size_t players, std::vector<Index> followed);

    // Of every player, and of every rush.
    void append(std::span<const PlayerState> players, std::span<const Take> takes);
    // One more, who was absent so far, and the rush that follows them. Precondition: fewer than max_players.
    void add_player();
    // Those before `beat`, sooner or later.
    void forget_before(Beat beat);

    [[nodiscard]] std::size_t players() const { return players_; }
    [[nodiscard]] std::size_t rushes() const { return followed_.size(); }
    [[nodiscard]] const std::vector<Index>& followed() const { return followed_; }
    [[nodiscard]] bool is_fixed(std::size_t rush) const { return followed_[rush] == nobody; }
    [[nodiscard]] std::size_t rush_following(Index player) const;
    [[nodiscard]] Beat beats() const { return first_ + static_cast<Beat>(rows_.size()); }
    [[nodiscard]] Beat first() const { return first_; }  // that is not forgotten

    // Preconditions: first() <= beat < beats().
    [[nodiscard]] const PlayerState& player(Beat beat, std::size_t player) const {
        return row(beat).players[player];
    }
    [[nodiscard]] const Take& take(Beat beat, std::size_t rush) const { return row(beat).takes[rush]; }
    [[nodiscard]] std::span<const PlayerState> players_at(Beat beat) const { return row(beat).players; }
    [[nodiscard]] std::span<const Take> takes_at(Beat beat) const { return row(beat).takes; }
    [[nodiscard]] std::span<const Meeting> meetings_at(Beat beat) const { return row(beat).meetings; }

    // The beats in which a rush's camera jumps, ascending.
    [[nodiscard]] const std::vector<Beat>& jumps(std::size_t rush) const { return jumps_[rush]; }
    // Whether it jumps in a beat after the first frame, as far as that is known.
    [[nodiscard]] bool jumps_late(Beat beat, std::size_t rush) const {
        return beat >= first_ && beat < beats() && take(beat, rush).late_cut;
    }

    // The rushes that show a player: rush r by bit r % 64 of word r / 64. Of nobody none, in as many words.
    using Word = std::uint64_t;
    static constexpr std::size_t word_bits = 64;
    [[nodiscard]] std::size_t words() const { return (rushes() + word_bits - 1) / word_bits; }
    [[nodiscard]] std::span<const Word> showing(Beat beat, Index player) const {
        return std::span(row(beat).showing)
            .subspan(std::min<std::size_t>(player, players_) * words(), words());
    }

  private:
    struct Row {
        std::vector<PlayerState> players;
        std::vector<Take> takes;
        std::vector<Meeting> meetings;
        std::vector<Word> showing;  // of each player, and of nobody
    };

    [[nodiscard]] const Row& row(Beat beat) const { return rows_[static_cast<std::size_t>(beat - first_)]; }
    void look_up_showing(Row& row) const;

    std::size_t players_;
    std::vector<Index> followed_;
    Beat first_ = 0;
    std::deque<Row> rows_;
    std::vector<std::vector<Beat>> jumps_;  // by rush
};

}  // namespace camdir::direction
