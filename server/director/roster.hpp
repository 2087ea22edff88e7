// The players of a match: those in its MatchInfo and those in its poses.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "director/messages.hpp"

namespace camdir::director {

enum class Presence { unknown, spectator, playing };

// One thread at a time.
class Roster {
  public:
    void clear();

    // Replaces the players of the MatchInfo.
    void set_listed(std::span<const Player> players);

    // Replaces the poses by those of a new frame; `poses` must outlive the calls of pose(). Returns the
    // number of poses skipped: duplicate players, and new players when 512 are known already. Players who are
    // not listed and have had no pose for `max_absent_frames` are forgotten. Allocates only for new players.
    std::uint64_t update(std::span<const PlayerPose> poses, std::int64_t max_absent_frames);

    // True when a presence may have changed since the last call.
    [[nodiscard]] bool take_changed();

    [[nodiscard]] Presence presence(std::uint32_t player) const;
    // 0: of any team.
    [[nodiscard]] bool anyone_playing(std::uint8_t team = 0) const;
    // Of the MatchInfo; 0 where it does not say.
    [[nodiscard]] std::uint8_t team(std::uint32_t player) const;
    // Everybody is of 0.
    [[nodiscard]] bool is_of(std::uint32_t player, std::uint8_t team) const {
        return team == 0 || this->team(player) == team;
    }
    // The player's pose in the last frame; null when there is none or the player is a spectator.
    [[nodiscard]] const PlayerPose* pose(std::uint32_t player) const;

  private:
    struct Entry {
        std::uint32_t player;
        bool listed;
        std::uint8_t team;  // 0 of who is not listed
        bool spectator;
        std::int64_t last_seen;  // value of frames_ then; 0 = never
        const PlayerPose* pose;
    };

    [[nodiscard]] const Entry* find(std::uint32_t player) const;
    Entry* find_or_add(std::uint32_t player);
    void forget_absent(std::int64_t max_absent_frames);

    std::vector<Entry> entries_;  // by player
    std::int64_t frames_ = 0;
    bool changed_ = false;
};

}  // namespace camdir::director
