#include "pose_arrays.hpp"

#include "checks.hpp"
#include "gather.hpp"

namespace camdir::sdk {

void PoseArrays::gather(const cdir_pose_frame& frame) {
    require(frame.player_count <= CDIR_MAX_PLAYERS, "player_count is greater than CDIR_MAX_PLAYERS");
    require(frame.reserved == 0, "frame.reserved is not 0");
    count_ = frame.player_count;
    has_velocity_ = count_ > 0 && frame.velocity != nullptr;
    if (count_ == 0) return;
    gather_array<1>("player_id", frame.player_id, frame.player_id_stride, count_, player_id_.data());
    check_player_ids(std::span(player_id_).first(count_));
    gather_array<3>("eye", frame.eye, frame.eye_stride, count_, eye_.data());
    gather_array<4>("orientation", frame.orientation, frame.orientation_stride, count_, orientation_.data());
    gather_array<1>("flags", frame.flags, frame.flags_stride, count_, flags_.data());
    require(all_finite(eye_.data(), 3 * count_), "an eye position is not finite");
    require(all_unit(orientation_.data(), count_), "an orientation is not of length 1");
    if (!has_velocity_) return;
    gather_array<3>("velocity", frame.velocity, frame.velocity_stride, count_, velocity_.data());
    require(all_finite(velocity_.data(), 3 * count_), "a velocity is not finite");
}

}  // namespace camdir::sdk
