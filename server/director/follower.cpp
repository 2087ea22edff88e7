#include "director/follower.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "director/clock.hpp"

namespace camdir::director {
namespace {

// In metres and in the cosine of half the angle between views.
struct Tolerance {
    float place, view;
};
// Trackers of the same poses agree better than this.
constexpr Tolerance in_time{0.0127F, 0.99999F};
// Where news is late only its guess can be followed: worth it where a shot is elsewhere.
constexpr Tolerance late{0.25F, 0.99F};
constexpr double longest_step_s = 0.25;

bool agree(const ShotCamera& a, const ShotCamera& b, float metres_per_unit, const Tolerance& tolerance) {
    return a.target == b.target && (a.position - b.position).norm() * metres_per_unit < tolerance.place &&
           std::abs(a.orientation.dot(b.orientation)) > tolerance.view;
}

const ShotCamera* camera_of(const CameraFrame& frame, std::uint32_t camera_id) {
    const auto found = std::ranges::find(frame.cameras, camera_id, &ShotCamera::camera_id);
    return found == frame.cameras.end() ? nullptr : &*found;
}

// Null where the frame does not tell.
const Reason* reason_of(const CameraFrame& frame, std::uint32_t camera_id) {
    const auto found = std::ranges::find(frame.reasons, camera_id, &ShotReason::camera_id);
    return found == frame.reasons.end() ? nullptr : &found->reason;
}

Shot* shot_of(std::vector<Shot>& shots, std::uint32_t camera_id) {
    const auto found = std::ranges::find(shots, camera_id, &Shot::camera_id);
    return found == shots.end() ? nullptr : &*found;
}

// Those of the same bake stand at the same places.
std::uint32_t fixed_shot_of(const ShotCamera& shown, const Follower::Setting& setting) {
    if (shown.target != no_player || !setting.fixed_shots) return freespace::none;
    const freespace::Freespace& map = setting.space.map();
    const auto shots = map.fixed_shots();
    const auto found = std::ranges::find_if(shots, [&](const freespace::FixedShot& shot) {
        return agree(shown, still_camera(shown.camera_id, shot), map.metadata().metres_per_unit, in_time);
    });
    return found == shots.end() ? freespace::none : static_cast<std::uint32_t>(found - shots.begin());
}

}  // namespace

void Follower::hear(CameraFrame& shown) {
    std::swap(shown_before_, shown_);
    std::swap(shown_, shown);
    is_followed_ = false;
}

void Follower::follow(const Setting& setting) {
    if (is_followed_) return;
    const CameraFrame* frame = own_of_shown_pose();
    if (frame == nullptr) return;
    is_followed_ = true;
    const float metres_per_unit = setting.space.map().metadata().metres_per_unit;
    const Tolerance& tolerance = frame->pose_number == own_[newest_].pose_number ? in_time : late;
    bool agrees = true;
    for (const ShotCamera& own : frame->cameras) {
        const ShotCamera* shown = camera_of(shown_, own.camera_id);
        if (shown == nullptr) continue;
        Shot* shot = shot_of(setting.shots, own.camera_id);
        if (shot != nullptr && shown->target == own.target) hear_reason(*shot);
        if (!agree(own, *shown, metres_per_unit, tolerance) && correct({own, *shown}, shot, setting))
            agrees = false;
    }
    if (!agrees) own_count_ = 0;  // they are not what the shots go on from
}

// Told with a cut and then once a second: whoever came in between has none yet.
void Follower::hear_reason(Shot& shot) const {
    const Reason* told = reason_of(shown_, shot.camera_id);
    if (told != nullptr && shot.automatic.reason.why.empty()) shot.automatic.reason = *told;
}

bool Follower::correct(const Disagreement& disagreement, Shot* shot, const Setting& setting) const {
    const auto& [own, shown] = disagreement;
    const ShotCamera* newest = camera_of(own_[newest_], own.camera_id);
    if (shot == nullptr || newest == nullptr || has_cut_since(own.camera_id)) return true;
    if (shown.target != own.target || shown.target == no_player) return correct_target(shown, *shot, setting);
    correct_place(disagreement, *newest, *shot, setting.space);
    return true;
}

bool Follower::correct_target(const ShotCamera& shown, Shot& shot, const Setting& setting) const {
    const std::uint32_t fixed = fixed_shot_of(shown, setting);
    const bool is_unknown = shown.target == no_player && fixed == freespace::none;
    if (is_unknown && (shown.flags & camera::target_absent) == 0)
        return false;  // another bake or configuration
    shot.automatic.follow(shown.target, fixed, shown_.frame_time, reason_of(shown_, shot.camera_id));
    return true;
}

void Follower::correct_place(const Disagreement& disagreement, const ShotCamera& newest, Shot& shot,
                             const freespace::Space& space) const {
    const auto& [own, shown] = disagreement;
    const ShotCamera* before = camera_of(shown_before_, own.camera_id);
    const double dt = seconds_between(shown_before_.frame_time, shown_.frame_time);
    const bool moved = before != nullptr && shown_before_.epoch == shown_.epoch && dt > 0.0 &&
                       dt <= longest_step_s && (shown.flags & camera::cut) == 0;
    if (!moved) return;
    const Vec3f way = newest.position - own.position;
    const Quatf turn = newest.orientation * own.orientation.conjugate();
    const auto since = [&](const ShotCamera& camera) {
        return camera::View{camera.position + way, turn * camera.orientation};
    };
    const bool goes_on =
        shot.is_of_group()
            ? camera::go_on_from(space, since(*before), since(shown), dt, shot.group)
            : camera::go_on_from(space, shot.profile, since(*before), since(shown), dt, shot.state);
    if (goes_on) shot.is_prepared = false;
}

std::span<const CameraFrame> Follower::own() const {
    return std::span(own_).first(std::min(own_count_, own_.size()));
}

// Null when there are none yet, or no more.
const CameraFrame* Follower::own_of_shown_pose() const {
    const auto frames = own();
    const auto found = std::ranges::find_if(frames, [&](const CameraFrame& frame) {
        return frame.epoch == shown_.epoch && frame.pose_number == shown_.pose_number;
    });
    return found == frames.end() ? nullptr : &*found;
}

// Since what the leader has shown.
bool Follower::has_cut_since(std::uint32_t camera_id) const {
    return std::ranges::any_of(own(), [&](const CameraFrame& frame) {
        const bool is_later = frame.epoch > shown_.epoch ||
                              static_cast<std::int32_t>(frame.pose_number - shown_.pose_number) > 0;
        const ShotCamera* camera = camera_of(frame, camera_id);
        return is_later && camera != nullptr && (camera->flags & camera::cut) != 0;
    });
}

}  // namespace camdir::director
