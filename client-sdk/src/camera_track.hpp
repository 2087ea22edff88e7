// One shot's last cameras, and the camera between them. Pure: no clock, no DDS.
#pragma once

#include <camera_director/camera_director.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace camdir::sdk {

// Keeps the newest `capacity` frames; allocates nothing.
class CameraTrack {
  public:
    static constexpr std::size_t capacity = 64;

    // `connected`: the camera moved here from the frame before, so that the way between may be interpolated;
    // false after a cut and wherever one may have got lost. A frame that is not newer than the newest is left
    // out.
    void add(std::int64_t frame_time, const cdir_camera& camera, bool connected);

    // The next camera is not connected, however it is added.
    void interrupt() { interrupted_ = true; }

    void clear();

    [[nodiscard]] std::optional<cdir_view> newest() const;

    // The frame at `frame_time` itself, or between two connected frames the interpolation: position and field
    // of view linear, orientation along the shorter arc, clearance such that it stays true; everything else
    // is the earlier frame's. Between two that are not connected the earlier one; outside of the track its
    // end. None when empty.
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
