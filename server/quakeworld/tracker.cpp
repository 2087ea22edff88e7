#include "quakeworld/tracker.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "base/view_angles.hpp"

namespace camdir::quakeworld {
namespace {

// Of the eye over the origin, map units.
constexpr float view_height = 22.0F;
constexpr float view_height_dead = -16.0F;
constexpr float view_height_gibbed = 8.0F;

constexpr double fastest = 2000.0;  // units/s, of the server's default limit in one axis: beyond, displaced
constexpr double fastest_run = 640.0;
constexpr double shortest_teleport = 48.0;  // units
constexpr double flash_reach = 96.0;        // units between the flash of a teleport and its player
constexpr std::int64_t late_turn_ms = 120;  // until which a server turns a player whom it has displaced
constexpr double late_turn = 20.0;          // degrees in one frame, at least

double seconds_between(const Frame& before, const Frame& after) {
    return static_cast<double>(after.time - before.time) * 1e-3;
}

double angle_between(const Vec3d& a, const Vec3d& b) {
    const auto forward = [](const Vec3d& angles) -> Vec3d {
        return quake_orientation(angles[0], angles[1], 0.0) * Vec3d::UnitX();
    };
    return std::acos(std::clamp(forward(a).dot(forward(b)), -1.0, 1.0)) / radians_of_a_degree<double>;
}

bool flashes_near(const Vec3d& place, const Frame& frame) {
    return std::ranges::any_of(frame.flashes,
                               [&](const Vec3d& flash) { return (flash - place).norm() < flash_reach; });
}

}  // namespace

Tracker::Member Tracker::Entry::member(Slot slot) const {
    const auto pose = std::ranges::lower_bound(frame.poses, slot, {}, &Pose::slot);
    if (pose == frame.poses.end() || pose->slot != slot) return {};
    return {&*pose, discontinuities[static_cast<std::size_t>(pose - frame.poses.begin())]};
}

void Tracker::add(Frame frame) {
    newest_ = frame.time;
    if (frame.poses.empty()) {
        if (!window_.empty())
            std::ranges::move(frame.occurrences, std::back_inserter(window_.back().frame.occurrences));
        return;
    }
    std::vector<bool> discontinuities;
    for (const Pose& pose : frame.poses)
        discontinuities.push_back(displaced(frame, pose));
    window_.push_back({std::move(frame), std::move(discontinuities)});
}

std::optional<TrackedFrame> Tracker::next() {
    if (!is_ready()) return std::nullopt;
    Entry& entry = window_.front();
    TrackedFrame tracked{entry.frame.time, {}, std::move(entry.frame.occurrences)};
    for (std::size_t i = 0; i < entry.frame.poses.size(); ++i) {
        const Pose& from = entry.frame.poses[i];
        TrackedPose& pose = tracked.poses.emplace_back();
        pose.slot = from.slot;
        pose.view_height = from.alive ? view_height : from.gibbed ? view_height_gibbed : view_height_dead;
        pose.eye = from.origin + Vec3d(0.0, 0.0, pose.view_height);
        pose.alive = from.alive;
        pose.discontinuity = entry.discontinuities[i];
        const Vec3d angles = settled_angles(from, pose.discontinuity);
        pose.orientation = quake_orientation(angles[0], angles[1], angles[2]);
        pose.velocity = velocity(from, pose.discontinuity);
    }
    before_ = std::move(entry);
    window_.pop_front();
    ++number_;
    return tracked;
}

bool Tracker::is_ready() const {
    if (window_.empty()) return false;
    return finished_ || newest_ - window_.front().frame.time > late_turn_ms;
}

bool Tracker::displaced(const Frame& frame, const Pose& pose) const {
    const Entry* last = !window_.empty() ? &window_.back() : before_ ? &*before_ : nullptr;
    const Pose* before = last != nullptr ? last->member(pose.slot).pose : nullptr;
    if (before == nullptr) return true;
    if (pose.alive && !before->alive) return true;
    const double moved = (pose.origin - before->origin).norm();
    const double seconds = seconds_between(last->frame, frame);
    if (moved > fastest * seconds + 8.0) return true;
    return moved > std::max(shortest_teleport, fastest_run * seconds + 32.0) &&
           flashes_near(pose.origin, frame);
}

// A server turns a player whom it displaces perhaps twice, as the player's own commands from before may turn
// them back in between: until the last such turn the view is what it ends in.
Vec3d Tracker::settled_angles(const Pose& pose, bool discontinuity) {
    Held& held = held_[pose.slot];
    if (discontinuity) {
        held = {};
        if (pose.alive) {
            const std::size_t end = end_of_turns(pose.slot);
            held = {number_ + end, window_[end].member(pose.slot).pose->angles};
        }
    }
    return number_ < held.until ? held.angles : pose.angles;
}

// The frame of the window with which the last of the large turns after the displacement in its first ends;
// the first itself when there is none. Large: also more than half of the largest.
std::size_t Tracker::end_of_turns(Slot slot) const {
    std::vector<double> turns = {0.0};
    const Pose* before = window_.front().member(slot).pose;
    for (std::size_t i = 1; i < window_.size(); ++i) {
        const Member now = window_[i].member(slot);
        if (now.pose == nullptr || now.discontinuity || !now.pose->alive ||
            window_[i].frame.time - window_.front().frame.time > late_turn_ms)
            break;
        turns.push_back(angle_between(before->angles, now.pose->angles));
        before = now.pose;
    }
    const double large = std::max(late_turn, 0.5 * *std::ranges::max_element(turns));
    for (std::size_t i = turns.size() - 1; i > 0; --i)
        if (turns[i] > large) return i;
    return 0;
}

// From the frame before to the frame after, as far as the player was not displaced.
Vec3d Tracker::velocity(const Pose& pose, bool discontinuity) const {
    const Frame* from = &window_.front().frame;
    const Frame* to = from;
    Vec3d begin = pose.origin;
    Vec3d end = pose.origin;
    if (!discontinuity) {
        from = &before_->frame;
        begin = before_->member(pose.slot).pose->origin;
    }
    if (window_.size() > 1) {
        const Member after = window_[1].member(pose.slot);
        if (after.pose != nullptr && !after.discontinuity) {
            to = &window_[1].frame;
            end = after.pose->origin;
        }
    }
    if (from == to) return Vec3d::Zero();
    return (end - begin) / seconds_between(*from, *to);
}

}  // namespace camdir::quakeworld
