#include "bench/cameras/spots.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bench/cameras/free_arm.hpp"
#include "bench/cameras/view_angles.hpp"
#include "evaluation/picture.hpp"

namespace camdir::bench {
namespace {

constexpr double spacing = 10.0;  // degrees, of the yaws
constexpr int yaws_to_a_side = 8;
constexpr double elevation_step = 25.0;  // degrees
constexpr int elevations = 3;
constexpr double steepest = 85.0;      // degrees, of a spot's pitch
constexpr double damping = 6.0;        // 1/s, of the direction
constexpr double blocked_cost = 10.0;  // radians for an arm of no length

class BestOfSpots {
  public:
    BestOfSpots(const EmbreeQueries& embree, double unit) : embree_(embree), unit_(unit) {}

    evaluation::CameraSample operator()(const evaluation::TracePose& pose, double seconds) {
        if (pose.discontinuity) angles_ = view_angles(pose);
        const ViewAngles goal = goal_of(pose);
        const double share = pose.discontinuity ? 1.0 : 1.0 - std::exp(-damping * seconds);
        angles_.yaw += share * turn_between(angles_.yaw, goal.yaw);
        angles_.pitch += share * (goal.pitch - angles_.pitch);
        const Eigen::Quaterniond orientation = orientation_of(angles_);
        const double free = free_arm(embree_, pose.eye, orientation, unit_);
        length_ = pose.discontinuity ? free : eased(length_, free, seconds);
        return {pose.eye - length_ * (orientation * Vec3d::UnitX()), orientation, pose.discontinuity};
    }

  private:
    [[nodiscard]] ViewAngles goal_of(const evaluation::TracePose& pose) const {
        const ViewAngles behind = view_angles(pose);
        if (blocked_share(pose.eye, behind) == 0.0) return behind;
        const Vec3d now = orientation_of(angles_) * Vec3d::UnitX();
        ViewAngles best = behind;
        double least = std::numeric_limits<double>::infinity();
        for (int i = 0; i < elevations; ++i)
            for (int j = -yaws_to_a_side; j <= yaws_to_a_side; ++j) {
                const ViewAngles spot{behind.yaw + j * spacing,
                                      std::clamp(behind.pitch + i * elevation_step, -steepest, steepest)};
                const double cost =
                    radians_of_a_degree<double> *
                        evaluation::degrees_between(orientation_of(spot) * Vec3d::UnitX(), now) +
                    blocked_cost * blocked_share(pose.eye, spot);
                if (cost < least) {
                    least = cost;
                    best = spot;
                }
            }
        return best;
    }

    // Of the desired distance; 0: the spot is free.
    [[nodiscard]] double blocked_share(const Vec3d& eye, const ViewAngles& spot) const {
        const double full = desired_distance * unit_;
        const double free = free_arm(embree_, eye, orientation_of(spot), unit_);
        return free >= full * (1.0 - 1e-9) ? 0.0 : 1.0 - free / full;
    }

    const EmbreeQueries& embree_;
    double unit_;
    ViewAngles angles_;
    double length_ = 0.0;  // map units
};

}  // namespace

Camera best_of_spots(const EmbreeQueries& embree, double unit) {
    return {"best of 51 spots", [&embree, unit] { return BestOfSpots(embree, unit); }};
}

}  // namespace camdir::bench
