#include "director/timeline.hpp"

#include <algorithm>
#include <limits>

#include "director/clock.hpp"

namespace camdir::director {
namespace {

constexpr double max_step_back_s = 1.0;
constexpr double history_s = 0.25;
constexpr std::ptrdiff_t worth_moving = 32;  // poses

// Of a second. Cameras decide at tenths: a standby that comes later at the same ones as its leader.
std::int64_t last_tenth(std::int64_t time) {
    constexpr std::int64_t tenth = 100'000'000;
    const std::int64_t since = (time % tenth + tenth) % tenth;
    return time >= std::numeric_limits<std::int64_t>::min() + since ? time - since : time;
}

}  // namespace

camera::Pose camera_pose(const PlayerPose& pose, bool discontinuity) {
    return {pose.eye, pose.orientation, pose.velocity, (pose.flags & pose_alive) != 0, discontinuity};
}

void Timeline::clear() {
    empty_ = true;
    shown_ = newest_ = 0.0;
    continuity_.clear();
    players_.clear();
    movers_.clear();
}

double Timeline::seconds(std::int64_t frame_time) const {
    return seconds_between(start_, frame_time);
}

bool Timeline::add(const PoseFrame& frame, std::span<const PlayerPose> poses) {
    if (empty_) start_ = last_tenth(frame.frame_time);
    const double time = seconds(frame.frame_time);
    if (!empty_ && time < newest_ - max_step_back_s) return false;
    if (!empty_ && time <= newest_) return true;
    empty_ = false;
    newest_ = time;
    for (const PlayerPose& pose : poses) {
        if ((pose.flags & pose_spectator) != 0) continue;
        std::vector<camera::TimedPose>& track = players_[pose.player_id];
        if (track.empty() || track.back().time < time)
            track.push_back({time, camera_pose(pose, continuity_.broken(pose)), true});
    }
    if (frame.movers || !movers_.empty()) movers_.push_back({time, frame.movers});
    for (auto& [player, track] : players_)
        if (track.back().time < time && track.back().present) track.push_back({time, {}, false});
    return true;
}

bool Timeline::covers(std::int64_t frame_time) const {
    const double time = seconds(frame_time);
    return !empty_ && time >= shown_ - max_step_back_s && time <= newest_;
}

void Timeline::show(std::int64_t frame_time) {
    shown_ = std::max(shown_, seconds(frame_time));
    const double oldest = shown_ - history_s;
    const auto kept = std::ranges::upper_bound(movers_, oldest, {}, &TimedMovers::time);
    if (kept - movers_.begin() > worth_moving) movers_.erase(movers_.begin(), kept - 1);  // one before stays
    for (auto player = players_.begin(); player != players_.end();) {
        auto& track = player->second;
        const std::ptrdiff_t stale = camera::index_at(track, oldest);  // the one before `oldest` stays
        if (stale >= worth_moving) track.erase(track.begin(), track.begin() + stale);
        const bool gone = !track.back().present && track.back().time < oldest;
        player = gone ? players_.erase(player) : std::next(player);
    }
}

void Timeline::add_to(std::vector<camera::Crowd::Player>& crowd, double time) const {
    for (const auto& [player, track] : players_) {
        const std::ptrdiff_t last = camera::index_at(track, time);
        if (last < 0) continue;
        const camera::TimedPose& pose = track[static_cast<std::size_t>(last)];
        if (pose.present && pose.pose.alive) crowd.push_back({player, track});
    }
}

camera::Window Timeline::window(std::uint32_t player) const {
    const auto found = players_.find(player);
    return found == players_.end() ? camera::Window() : camera::Window(found->second);
}

}  // namespace camdir::director
