// The last cameras of one shot, and interpolation between them. Pure: no clock, no DDS.
#pragma once

#include <camera_director/camera_director.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace camdir::sdk {

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

    [[nodiscard]] std::optional<cdir_view> newest() const;

    // The camera at `frame_time`. Between connected frames it is interpolated: position and field of view
    // linearly, orientation along the shorter arc, clearance as a lower bound; all else is the earlier
    // frame's. Between unconnected frames it is the earlier one, outside of the track the nearest. None when
    // empty.
    [[nodiscard]] std::optional<cdir_view> at(std::int64_t frame_time) const;

  private:
    struct Frame {
        std::int64_t time;
        std::uint32_t segment;
        cdir_camera camera;
    };

    [[nodiscard]] const Frame& frame(std::size_t age_rank) const;  // 0 = the oldest
    [[nodiscard]] std::size_t first_after(std::int64_t frame_time) const;

    std::array<Frame, capacity> frames_{};
    std::size_t begin_ = 0;
    std::size_t size_ = 0;
    std::uint32_t segment_ = 0;
    bool interrupted_ = true;
};

}  // namespace camdir::sdk
