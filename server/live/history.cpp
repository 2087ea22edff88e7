#include "live/history.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "camera/camera.hpp"

namespace camdir::live {
namespace {

bool is_told_later(std::uint32_t kind) {
    using Kind = director::MatchEventKind;
    static constexpr std::array told = {Kind::kill,      Kind::flag_taken, Kind::flag_captured,
                                        Kind::objective, Kind::award,      Kind::round};
    return std::ranges::find(told, static_cast<Kind>(kind)) != told.end();
}

bool was_moved(const director::PoseFrame& poses, std::uint32_t player) {
    const auto pose = std::ranges::find(poses.poses, player, &director::PlayerPose::player_id);
    return pose != poses.poses.end() && (pose->flags & director::pose_discontinuity) != 0;
}

CutReason reason_of(const ShotState* before, const ShotState& now, const director::PoseFrame& poses) {
    if (before == nullptr) return CutReason::begin;
    const bool is_fixed = now.target == director::no_player && (now.flags & camera::target_absent) == 0;
    if (before->target != now.target || is_fixed) return CutReason::target;
    if (was_moved(poses, now.target)) return CutReason::moved;
    if ((before->flags & camera::target_visible) == 0) return CutReason::hidden;
    return CutReason::viewpoint;
}

// Of an automatic shot; told again once a second, so of a cut only with a new target.
std::optional<director::Reason> moment_of(const director::CameraFrame& cameras, const Cut& cut) {
    if (cut.reason != CutReason::begin && cut.reason != CutReason::target) return std::nullopt;
    const auto found = std::ranges::find(cameras.reasons, cut.camera_id, &director::ShotReason::camera_id);
    return found == cameras.reasons.end() ? std::nullopt : std::optional(found->reason);
}

}  // namespace

std::vector<Cut> History::add(const director::PoseFrame& poses, const director::CameraFrame& cameras) {
    std::vector<Cut> cuts;
    std::map<std::uint32_t, ShotState> before = std::exchange(shots_, {});
    for (const director::ShotCamera& camera : cameras.cameras) {
        const ShotState now{cameras.frame_time, camera.camera_id, camera.target,
                            camera.flags & ~std::uint32_t{camera::cut}};
        const auto found = before.find(camera.camera_id);
        const ShotState* last = found == before.end() ? nullptr : &found->second;
        if ((camera.flags & camera::cut) != 0 || last == nullptr) {
            cuts.push_back({now.frame_time, now.camera_id, now.target, reason_of(last, now, poses)});
            cuts.back().moment = moment_of(cameras, cuts.back());
        }
        if (last == nullptr || last->target != now.target || last->flags != now.flags) add_state(now);
        shots_.emplace(now.camera_id, now);
        if (last != nullptr) before.erase(found);
    }
    for (auto& [id, gone] : before) {
        gone.frame_time = cameras.frame_time;
        gone.present = false;
        add_state(gone);
    }
    return cuts;
}

void History::add_state(const ShotState& state) {
    states_.push_back(state);
    if (states_.size() > max_states) states_.pop_front();
}

void History::keep_cut(SharedMessage note) {
    cuts_.push_back(std::move(note));
    if (cuts_.size() > max_cuts) cuts_.pop_front();
}

void History::keep(const director::MatchEvent& event, SharedMessage note) {
    if (!is_told_later(event.kind)) return;
    events_.push_back(std::move(note));
    if (events_.size() > max_events) events_.pop_front();
}

}  // namespace camdir::live
