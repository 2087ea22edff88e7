// Match: the shots of a standby go on from the cameras of the director that leads.
#include <algorithm>

#include "director/clock.hpp"
#include "director/match.hpp"

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

}  // namespace

// A frame of a pose that is not processed yet waits until it is.
void Match::follow() {
    if (content_.has_shown) {
        std::swap(followed_before_, followed_);
        std::swap(followed_, content_.shown);
        is_followed_ = false;
    }
    if (is_followed_ || !freespace_) return;
    const CameraFrame* frame = own_frame(followed_);
    if (frame == nullptr) return;
    is_followed_ = true;
    const Tolerance& tolerance = frame->pose_number == own_frames_[newest_own_].pose_number ? in_time : late;
    bool agrees = true;
    for (const ShotCamera& own : frame->cameras) {
        const ShotCamera* shown = camera_of(followed_, own.camera_id);
        if (shown != nullptr && shown->target == own.target) hear_reason(own.camera_id);
        if (shown == nullptr || agree(own, *shown, freespace_->metadata().metres_per_unit, tolerance))
            continue;
        if (follow({own, *shown})) agrees = false;
    }
    if (!agrees) own_frame_count_ = 0;  // they are not what the shots go on from
}

// Told with a cut and then once a second: whoever came in between has none yet.
void Match::hear_reason(std::uint32_t camera_id) {
    const Reason* told = reason_of(followed_, camera_id);
    std::vector<Shot>& shots = requests_.shots();
    const auto shot = std::ranges::find(shots, camera_id, &Shot::camera_id);
    if (told != nullptr && shot != shots.end() && shot->automatic.reason.why.empty())
        shot->automatic.reason = *told;
}

// Where this director is ahead, the leader's camera is taken to have moved since as its own did.
bool Match::follow(const Disagreement& disagreement) {
    const auto& [own, shown] = disagreement;
    std::vector<Shot>& shots = requests_.shots();
    const auto shot = std::ranges::find(shots, own.camera_id, &Shot::camera_id);
    const ShotCamera* newest = camera_of(own_frames_[newest_own_], own.camera_id);
    if (shot == shots.end() || newest == nullptr || has_cut_since(followed_, own.camera_id)) return true;
    if (shown.target != own.target || shown.target == no_player) {
        const std::uint32_t fixed = fixed_shot_of(shown);
        const bool is_unknown = shown.target == no_player && fixed == freespace::none;
        if (is_unknown && (shown.flags & camera::target_absent) == 0)
            return false;  // another bake or configuration
        shot->automatic.follow(shown.target, fixed, followed_.frame_time,
                               reason_of(followed_, own.camera_id));
        return true;  // the next frame begins with it
    }
    const ShotCamera* before = camera_of(followed_before_, own.camera_id);
    const double dt = seconds_between(followed_before_.frame_time, followed_.frame_time);
    const bool moved = before != nullptr && followed_before_.epoch == followed_.epoch && dt > 0.0 &&
                       dt <= longest_step_s && (shown.flags & camera::cut) == 0;
    if (!moved) return true;
    const Vec3f way = newest->position - own.position;
    const Quatf turn = newest->orientation * own.orientation.conjugate();
    const auto since = [&](const ShotCamera& camera) {
        return camera::View{camera.position + way, turn * camera.orientation};
    };
    const bool goes_on =
        shot->is_of_group()
            ? camera::go_on_from(space(), since(*before), since(shown), dt, shot->group)
            : camera::go_on_from(space(), shot->profile, since(*before), since(shown), dt, shot->state);
    if (goes_on) shot->is_prepared = false;
    return true;
}

// Those of the same bake stand at the same places.
std::uint32_t Match::fixed_shot_of(const ShotCamera& shown) const {
    if (shown.target != no_player || !config_->direction.grammar.fixed_shots) return freespace::none;
    const auto shots = freespace_->fixed_shots();
    const auto found = std::ranges::find_if(shots, [&](const freespace::FixedShot& shot) {
        return agree(shown, still_camera(shown.camera_id, shot), freespace_->metadata().metres_per_unit,
                     in_time);
    });
    return found == shots.end() ? freespace::none : static_cast<std::uint32_t>(found - shots.begin());
}

std::span<const CameraFrame> Match::own_frames() const {
    return std::span(own_frames_).first(std::min(own_frame_count_, own_frames_.size()));
}

// Of the same pose; null when there is none yet, or no more.
const CameraFrame* Match::own_frame(const CameraFrame& shown) const {
    const auto frames = own_frames();
    const auto found = std::ranges::find_if(frames, [&](const CameraFrame& own) {
        return own.epoch == shown.epoch && own.pose_number == shown.pose_number;
    });
    return found == frames.end() ? nullptr : &*found;
}

bool Match::has_cut_since(const CameraFrame& shown, std::uint32_t camera_id) const {
    return std::ranges::any_of(own_frames(), [&](const CameraFrame& own) {
        const bool is_later =
            own.epoch > shown.epoch || static_cast<std::int32_t>(own.pose_number - shown.pose_number) > 0;
        const ShotCamera* camera = camera_of(own, camera_id);
        return is_later && camera != nullptr && (camera->flags & camera::cut) != 0;
    });
}

}  // namespace camdir::director
