// What one observer sees of a match while its directors come and go, measured against the match that is
// replayed.
#pragma once

#include <camera_director/camera_director.hpp>
#include <cstdint>
#include <optional>

#include "base/geometry.hpp"
#include "evaluation/trace.hpp"

namespace camdir::soak {

struct HandOver {
    double gap_ms = 0.0;         // longest time without the observer's camera
    std::uint64_t lost = 0;      // pose frames without one
    std::uint64_t stale = 0;     // frames not newer than the one before
    std::uint64_t changes = 0;   // of the director
    std::uint64_t unforced = 0;  // cuts where the player did not respawn, teleport or die
    // Largest step without a cut, in map units: less that of the player where this one did not jump.
    double leap = 0.0;
    std::uint64_t unanswered = 0;  // frames during which the answer was not "accepted"
    double silent_s = 0.0;         // since the last camera, at the end
};

// One thread at a time.
class HandOverRecord {
  public:
    // `trace` is replayed from its first frame at `rate_hz`; the observer's shot shows `player`.
    HandOverRecord(const evaluation::Trace& trace, double rate_hz, std::uint32_t player)
        : trace_(trace), rate_hz_(rate_hz), player_(player) {}

    // Measuring begins, at `now` in s.
    void begin(double now);
    void add(const camera_director::CameraFrame& frame, const camera_director::Camera* own, double now);
    // With the time since the last camera.
    [[nodiscard]] HandOver finish(double now);

    [[nodiscard]] std::optional<std::uint64_t> director() const;

  private:
    struct Seen {
        camera_director::CameraFrame frame;
        Vec3d camera;
        double time;
    };

    [[nodiscard]] std::int64_t index_of(const camera_director::CameraFrame& frame) const;
    [[nodiscard]] const evaluation::TracePose* pose_at(std::int64_t index) const;
    [[nodiscard]] bool is_broken(std::int64_t from, std::int64_t to) const;
    [[nodiscard]] bool is_stale(const camera_director::CameraFrame& frame) const;
    void compare(const Seen& before, const Seen& seen, bool cut);

    const evaluation::Trace& trace_;
    const double rate_hz_;
    const std::uint32_t player_;
    std::optional<Seen> last_;                            // with the observer's camera
    std::optional<camera_director::CameraFrame> newest_;  // with it or not
    double begun_ = 0.0;
    HandOver found_;
};

}  // namespace camdir::soak
