// The players of a match: listed in its MatchInfo, or seen in its poses.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "director/messages.hpp"

namespace camdir::director {

inline constexpr std::uint32_t pose_alive = 1;
inline constexpr std::uint32_t pose_discontinuity = 2;
inline constexpr std::uint32_t pose_spectator = 4;

enum class Presence { unknown, spectator, playing };

class Roster {
  public:
    void clear();

    // Replaces the list of the MatchInfo.
    void list(std::span<const Player> players);

    // Takes in a frame, of which `poses` must stay while it is asked for. Returns the poses left out: players
    // twice in it, and unlisted ones when too many are known. Players without a pose for `patience` frames
    // are forgotten unless listed. Allocates only when a player is new.
    std::uint64_t see(std::span<const PlayerPose> poses, std::int64_t patience);

    // Whether a presence may have changed since the last call.
    [[nodiscard]] bool take_changed();

    [[nodiscard]] Presence presence(std::uint32_t player) const;
    [[nodiscard]] bool anybody_playing() const;
    // In the last frame; null when he has none there or is a spectator.
    [[nodiscard]] const PlayerPose* pose(std::uint32_t player) const;

  private:
    struct Entry {
        std::uint32_t player;
        bool listed;
        bool spectator;
        std::int64_t last_seen;  // frame of frames_; 0 = never
        const PlayerPose* pose;
    };

    [[nodiscard]] const Entry* find(std::uint32_t player) const;
    Entry* find_or_add(std::uint32_t player);
    void forget_absent(std::int64_t patience);

    std::vector<Entry> entries_;  // by player
    std::int64_t frames_ = 0;
    bool changed_ = false;
};

}  // namespace camdir::director
