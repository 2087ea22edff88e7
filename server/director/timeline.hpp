// What a delay lets be known of a match: its players' poses and movers around the time that is shown.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <vector>

#include "camera/crowd.hpp"
#include "director/continuity.hpp"
#include "director/messages.hpp"

namespace camdir::director {

// As trackers take it. `discontinuity`: the player has respawned or teleported since the pose that they had
// before, which may be older than what the pose itself declares.
[[nodiscard]] camera::Pose camera_pose(const PlayerPose& pose, bool discontinuity);

// Null: the match has no movers.
struct TimedMovers {
    double time;
    std::shared_ptr<const MatchMovers> movers;
};

// Times are seconds of the game's clock since the last whole tenth of one before the first frame. One thread
// at a time.
class Timeline {
  public:
    void clear();
    [[nodiscard]] bool empty() const { return empty_; }

    // Adds the poses of the frame after the newest one. Returns false when the game's clock has gone back
    // by more than a second since: it can begin another timeline. One that goes back by less, or stands
    // still, adds nothing.
    bool add(const PoseFrame& frame, std::span<const PlayerPose> poses);

    // Whether a frame of this time can be shown: it is among those added, or its clock stands still.
    [[nodiscard]] bool covers(std::int64_t frame_time) const;
    // Shows this time, which is covered, or goes on showing a later one. Forgets what is older than 0.25 s.
    void show(std::int64_t frame_time);

    [[nodiscard]] double shown() const { return shown_; }
    [[nodiscard]] double seconds(std::int64_t frame_time) const;
    // Valid until the next add(), show() or clear().
    [[nodiscard]] camera::Window window(std::uint32_t player) const;
    // Of all players who live then, likewise.
    void add_to(std::vector<camera::Crowd::Player>& crowd, double time) const;
    // Ascending, likewise; empty before the first.
    [[nodiscard]] std::span<const TimedMovers> movers() const { return movers_; }

  private:
    bool empty_ = true;
    std::int64_t start_ = 0;
    double newest_ = 0.0;
    double shown_ = 0.0;
    Continuity continuity_;
    std::map<std::uint32_t, std::vector<camera::TimedPose>> players_;
    std::vector<TimedMovers> movers_;
};

}  // namespace camdir::director
