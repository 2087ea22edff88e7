// Checks the cameras that one observer receives.
#pragma once

#include <camera_director/camera_director.hpp>
#include <cstdint>
#include <optional>

#include "base/geometry.hpp"
#include "latencies.hpp"
#include "oracle/oracle.hpp"

namespace camdir::soak {

struct Findings {
    std::uint64_t frames = 0;    // camera frames received
    std::uint64_t cameras = 0;   // of these, frames with the observer's own camera
    std::uint64_t gaps = 0;      // frames missing between them, by frame_number
    std::uint64_t disorder = 0;  // frames not newer than the previous one
    std::uint64_t early = 0;     // frames that left before they were due
    std::uint64_t hand_overs = 0;
    std::uint64_t epochs = 0;
    std::uint64_t invalid = 0;  // samples that the SDK dropped as malformed
    // Of the observer's camera:
    std::uint64_t cuts = 0, visible = 0, searching = 0, absent = 0, held = 0;
    std::uint64_t in_obstacle = 0;       // inside a solid, or nearer to an obstacle than the limit
    std::uint64_t through_geometry = 0;  // steps through an obstacle without a cut
    std::uint64_t jumps = 0;             // steps longer than the limit without a cut
    Latencies lateness;                  // from when frames were due to when they left
    Latencies latency;                   // from when frames were due to their arrival

    void add(const Findings& other);
};

struct Limits {
    double step = 64.0;      // map units from one pose frame to the next
    double clearance = 0.0;  // map units; cameras nearer to an obstacle count as in it
    double delay = 0.0;      // s, of the match: frames are due so long after the source_time of their poses
};

// One thread at a time. `oracle`, which may be null, must outlive it.
class ShotChecker {
  public:
    ShotChecker(const oracle::Oracle* oracle, const Limits& limits) : oracle_(oracle), limits_(limits) {}

    // `own` is the observer's camera in the frame, if it has one. `received` is CLOCK_REALTIME, ns.
    void check(const camera_director::CameraFrame& frame, const camera_director::Camera* own,
               std::int64_t received);

    [[nodiscard]] Findings& findings() { return findings_; }
    [[nodiscard]] const Findings& findings() const { return findings_; }
    // The observer's camera of the newest frame.
    [[nodiscard]] std::optional<camera_director::Camera> latest() const {
        return previous_ ? previous_->own : std::nullopt;
    }

  private:
    struct Previous {
        camera_director::CameraFrame frame;
        std::optional<camera_director::Camera> own;
    };

    [[nodiscard]] bool follows(const camera_director::CameraFrame& frame);
    void check_camera(const camera_director::Camera& camera);
    void check_step(const Vec3d& from, const Vec3d& to, std::uint32_t pose_frames);

    const oracle::Oracle* oracle_;
    Limits limits_;
    Findings findings_;
    std::optional<Previous> previous_;
};

}  // namespace camdir::soak
