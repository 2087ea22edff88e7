// The last cameras of one shot, and interpolation between them. Pure: no clock, no DDS.
#pragma once

#include <camera_director/camera_director.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "camera_motion.hpp"

namespace camdir::sdk {

// The shot's camera at one time; the fields are those of cdir_view.
struct View {
    std::uint32_t segment;
    std::int64_t frame_time;
    std::int64_t late;
    cdir_camera camera;
};

// Keeps the newest `capacity` frames. Allocates nothing. One thread at a time.
class CameraTrack {
  public:
    static constexpr std::size_t capacity = 64;

    // `connected`: the camera moved continuously from the previous frame, so that interpolation is allowed;
    // false after a cut and where a cut may have been lost. A frame that is not newer than the newest is
    // skipped.
    void add(std::int64_t frame_time, const cdir_camera& camera, bool connected);

    // The next frame counts as not connected.
    void interrupt() { interrupted_ = true; }

    void clear();

    [[nodiscard]] std::optional<View> newest() const;

    // The camera at `frame_time`. Between connected frames it is camera_between() them, between unconnected
    // ones the earlier one, outside of the track the nearest. None when empty.
    //
    // A frame's velocity is settled when it is first needed, by the frames that are known then: by the ones
    // before and after it, or by the two before it. So the camera never waits for a frame, and none that
    // comes later bends a way that is being shown.
    [[nodiscard]] std::optional<View> at(std::int64_t frame_time);

  private:
    struct Frame {
        std::int64_t time;
        std::uint32_t segment;
        cdir_camera camera;
        std::optional<CameraVelocity> velocity;  // once settled
    };

    [[nodiscard]] const Frame& frame(std::size_t age_rank) const;  // 0 = the oldest
    [[nodiscard]] Frame& frame(std::size_t age_rank);
    // With the frame before it; false when there is none.
    [[nodiscard]] bool connected(std::size_t age_rank) const;
    [[nodiscard]] CameraStep step_to(std::size_t age_rank) const;
    // Of a frame that is connected with the one before or after it.
    [[nodiscard]] CameraVelocity velocity_at(std::size_t age_rank) const;
    [[nodiscard]] CameraState settled(std::size_t age_rank);
    [[nodiscard]] std::size_t first_after(std::int64_t frame_time) const;

    std::array<Frame, capacity> frames_{};
    std::size_t begin_ = 0;
    std::size_t size_ = 0;
    std::uint32_t segment_ = 0;
    bool interrupted_ = true;
};

}  // namespace camdir::sdk
