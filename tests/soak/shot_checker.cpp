#include "shot_checker.hpp"

#include <algorithm>
#include <cmath>

namespace camdir::soak {
namespace {

Vec3d position_of(const camera_director::Camera& camera) {
    return Eigen::Map<const Vec3f>(camera.position).cast<double>();
}

double seconds_since(std::int64_t due, std::int64_t time) {
    return static_cast<double>(time - due) * 1e-9;
}

}  // namespace

void Findings::add(const Findings& other) {
    for (const auto member :
         {&Findings::frames, &Findings::cameras, &Findings::gaps, &Findings::disorder, &Findings::early,
          &Findings::hand_overs, &Findings::epochs, &Findings::invalid, &Findings::cuts, &Findings::visible,
          &Findings::searching, &Findings::absent, &Findings::held, &Findings::in_obstacle,
          &Findings::through_geometry, &Findings::jumps}) {
        this->*member += other.*member;
    }
    lateness.add(other.lateness);
    latency.add(other.latency);
}

void ShotChecker::check(const camera_director::CameraFrame& frame, const camera_director::Camera* own,
                        std::int64_t received) {
    ++findings_.frames;
    const std::int64_t due = frame.source_time + std::llround(1e9 * limits_.delay);
    findings_.early += frame.write_time < due ? 1 : 0;
    findings_.lateness.add(seconds_since(due, frame.write_time));
    findings_.latency.add(seconds_since(due, received));
    const bool consecutive = follows(frame);
    if (own != nullptr) {
        check_camera(*own);
        const bool comparable = consecutive && previous_->own && previous_->own->camera_id == own->camera_id;
        if (comparable && (own->flags & CDIR_CAMERA_CUT) == 0) {
            check_step(position_of(*previous_->own), position_of(*own),
                       frame.pose_number - previous_->frame.pose_number);
        }
    }
    previous_ = {frame, own != nullptr ? std::optional(*own) : std::nullopt};
}

// Counts gaps and changes between the previous frame and this one; true when there are none.
bool ShotChecker::follows(const camera_director::CameraFrame& frame) {
    if (!previous_) return false;
    const camera_director::CameraFrame& before = previous_->frame;
    if (frame.epoch != before.epoch) {
        ++findings_.epochs;
        return false;
    }
    if (frame.director_id != before.director_id) {
        ++findings_.hand_overs;
        return false;
    }
    if (frame.frame_number <= before.frame_number) {
        ++findings_.disorder;
        return false;
    }
    findings_.gaps += frame.frame_number - before.frame_number - 1;
    return frame.frame_number == before.frame_number + 1;
}

void ShotChecker::check_camera(const camera_director::Camera& camera) {
    ++findings_.cameras;
    const auto has = [&](std::uint32_t flag) { return (camera.flags & flag) != 0 ? 1U : 0U; };
    findings_.cuts += has(CDIR_CAMERA_CUT);
    findings_.visible += has(CDIR_CAMERA_TARGET_VISIBLE);
    findings_.searching += has(CDIR_CAMERA_SEARCHING);
    findings_.absent += has(CDIR_CAMERA_TARGET_ABSENT);
    findings_.held += has(CDIR_CAMERA_HELD);
    if (oracle_ != nullptr && oracle_->clearance(position_of(camera)) < limits_.clearance) {
        ++findings_.in_obstacle;
    }
}

// A director that had to wait goes on with the newest pose frame.
void ShotChecker::check_step(const Vec3d& from, const Vec3d& to, std::uint32_t pose_frames) {
    if ((to - from).norm() > limits_.step * std::max(1U, pose_frames)) ++findings_.jumps;
    if (oracle_ != nullptr && !oracle_->segment_clear(from, to)) ++findings_.through_geometry;
}

}  // namespace camdir::soak
