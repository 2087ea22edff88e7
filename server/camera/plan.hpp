// What the parts of the planner work on: the player's future and the camera's, sample by sample.
#pragma once

#include <array>
#include <span>

#include "base/float4.hpp"
#include "camera/future.hpp"
#include "camera/smoother.hpp"

namespace camdir::camera {

// The camera and what it follows, at one instant. Yaws are continuous from one sample to the next.
struct PlannedSample {
    Vec3d position = Vec3d::Zero();
    Vec3d eye = Vec3d::Zero();  // of the player, smoothed
    double heading_yaw = 0.0;   // of the player's view, smoothed, rad
    double heading_pitch = 0.0;
    double look_yaw = 0.0;  // of the camera, rad
    double look_pitch = 0.0;
};

// The last two samples before a plan, the last one second.
using History = std::array<PlannedSample, 2>;

struct Plan {
    static constexpr std::size_t capacity = Future::capacity;
    static_assert(capacity <= Smoother::capacity && capacity % lane_count == 0);
    template <class Value>
    using PerSample = std::array<Value, capacity>;

    Future future;
    bool ahead = false;            // a recorded future, not only a prediction
    std::size_t knot_spacing = 1;  // samples between two knots
    PerSample<Vec3f> view;         // direction of the player's view
    PerSample<double> heading_yaw;
    PerSample<double> heading_pitch;
    PerSample<Vec3d> eye;      // smoothed
    PerSample<Vec3d> goal;     // of the camera
    PerSample<double> length;  // distance of the goal from the player
    PerSample<Vec3d> position;
    PerSample<double> look_yaw;
    PerSample<double> look_pitch;

    PerSample<double> weights;
    PerSample<double> weights_before;
    PerSample<double> wanted;

    [[nodiscard]] std::size_t count() const { return future.count; }
    // At least 1.
    [[nodiscard]] std::size_t samples_in(double seconds) const;
    // How far off straight behind a player's own view the camera begins to show them from the side, rad.
    [[nodiscard]] static float side_view(const MapProfile& profile);
    // Where the camera stands from the player when it is straight behind; `elevation` above that, rad.
    [[nodiscard]] Look behind(std::size_t i, float elevation) const;

    // Sets `view` from the future.
    void find_views();
    // The smoother of the plan's weights. Valid until the next call.
    [[nodiscard]] const Smoother& smoother(double time_constant);
    // A smoothed curve through wanted[i] with weights[i], after two values of history.
    void smooth(double time_constant, double before_last, double last, PerSample<double>& values);
    // The same; deviations within `dead_zone` weigh a tenth, and those beyond the more the further they are,
    // up to `gain` more, in `rounds` reweightings.
    void smooth_with_dead_zone(double time_constant, double dead_zone, double gain, int rounds,
                               double before_last, double last, PerSample<double>& values);

  private:
    // A smoother of equal weights is the same from plan to plan.
    struct EvenSmoother {
        std::size_t count = 0;
        double stiffness = 0.0;
        Smoother smoother;
    };
    Smoother smoother_;
    std::array<EvenSmoother, 8> even_;  // a plan uses five
    std::size_t next_even_ = 0;         // that makes room
};

}  // namespace camdir::camera
