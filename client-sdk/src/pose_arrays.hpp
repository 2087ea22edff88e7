// The poses of one frame, gathered from wherever the engine keeps them.
#pragma once

#include <camera_director/camera_director.h>

#include <array>
#include <cstddef>
#include <cstdint>

namespace camdir::sdk {

// Packed arrays, as they are sent. One thread at a time.
class PoseArrays {
  public:
    // Copies the frame's arrays. Throws a Failure with CDIR_INVALID_ARGUMENT that says what is wrong with
    // them: more than CDIR_MAX_PLAYERS, null, a stride that is too short, or an impossible number.
    void gather(const cdir_pose_frame& frame);

    [[nodiscard]] std::size_t count() const { return count_; }
    [[nodiscard]] bool has_velocity() const { return has_velocity_; }
    [[nodiscard]] const std::uint32_t* player_id() const { return player_id_.data(); }  // count()
    [[nodiscard]] const float* eye() const { return eye_.data(); }                      // 3 count()
    [[nodiscard]] const float* orientation() const { return orientation_.data(); }      // 4 count()
    [[nodiscard]] const float* velocity() const { return velocity_.data(); }            // 3 count()
    [[nodiscard]] const std::uint32_t* flags() const { return flags_.data(); }          // count()

  private:
    std::size_t count_ = 0;
    bool has_velocity_ = false;
    std::array<std::uint32_t, CDIR_MAX_PLAYERS> player_id_, flags_;
    std::array<float, 3 * CDIR_MAX_PLAYERS> eye_, velocity_;
    std::array<float, 4 * CDIR_MAX_PLAYERS> orientation_;
};

}  // namespace camdir::sdk
