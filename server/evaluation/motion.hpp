// How a camera moves and turns within one segment: speeds and their derivatives by finite differences.
#pragma once

#include <cstdint>
#include <deque>

#include "evaluation/camera_path.hpp"
#include "evaluation/statistics.hpp"

namespace camdir::evaluation {

// A comfortable frame turns at most at `comfortable_turn`, and over the last second, or since its segment
// began, the view axis has turned at less than `comfortable_sweep` on average: the angles from frame to frame
// summed, from the earliest frame that is at most 1 s old.
//
// A turn of the axis by 1 radian a second moves what is far away and in the middle of the picture by half of
// the width of a view of 90 degrees: the picture's width is 2 as tangents. Roll and the camera's own way do
// not count in it: how much they move the picture depends on what is in it.
inline constexpr double comfortable_turn = 120.0;                               // degrees/s
inline constexpr double comfortable_sweep = 1.0 / radians_of_a_degree<double>;  // degrees/s

// Of one camera; map units, degrees, seconds. `unmeasured` where its segment is too young: a speed takes two
// cameras, an acceleration three, a jerk four.
struct Motion {
    double acceleration = unmeasured;
    double jerk = unmeasured;
    double angular_speed = unmeasured;
    double angular_acceleration = unmeasured;
    double rotation = unmeasured;  // since the camera before
    bool comfortable = false;      // of cameras with an angular speed
};

// Takes the cameras of one player in order.
class MotionMeter {
  public:
    // The next camera does not belong to the segment of the one before.
    void end_segment() {
        length_ = 0;
        sweep_.clear();
    }

    // `time` in nanoseconds, ascending strictly.
    Motion add(std::int64_t time, const CameraSample& camera);

  private:
    struct State {
        std::int64_t time = 0;  // nanoseconds
        double step = 0.0;      // seconds since the state before
        Vec3d position = Vec3d::Zero();
        Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
        Vec3d velocity = Vec3d::Zero();
        Vec3d angular_velocity = Vec3d::Zero();  // degrees a second
        Vec3d acceleration = Vec3d::Zero();
    };

    // How far the view axis has turned since the segment began.
    struct Sweep {
        std::int64_t time;  // nanoseconds
        double degrees;
    };

    // The mean speed at which the view axis has turned over the last second; `degrees`: since the last frame.
    double sweep_speed(std::int64_t time, double degrees);

    int length_ = 0;  // cameras of the segment so far
    State last_;
    double step_before_last_ = 0.0;
    std::deque<Sweep> sweep_;  // of the last second
};

}  // namespace camdir::evaluation
