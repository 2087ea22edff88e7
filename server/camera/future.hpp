// Where the player is, and where they look, from now on: the recorded poses as far as they are known, then a
// prediction.
#pragma once

#include <array>

#include "camera/profile.hpp"
#include "camera/view.hpp"
#include "camera/window.hpp"
#include "freespace/space.hpp"

namespace camdir::camera {

struct Future {
    static constexpr std::size_t capacity = 384;
    struct Sample {
        Vec3f eye;
        Look view;  // yaw without jumps by a whole turn from one sample to the next
    };

    double start = 0.0;     // s, of the first sample
    double step = 0.0;      // s
    std::size_t count = 0;  // >= 1
    std::size_t known = 0;  // samples from recorded poses
    std::array<Sample, capacity> samples;

    [[nodiscard]] const Sample& operator[](std::size_t i) const { return samples[i]; }
};

// Fills `future` with samples `step` apart from `start` on, at which the window has a usable pose: to the end
// of the continuous stretch, but no further than `horizon`, and from there a prediction: the velocity fades,
// falling sooner than running, and so does the turning; walls stop it. `yaw` is a yaw that the first one
// should be near to.
void foresee(const freespace::Space& space, const MapProfile& profile, Window window, double start,
             double step, double horizon, float yaw, freespace::RecentBalls& balls, Future& future);

}  // namespace camdir::camera
