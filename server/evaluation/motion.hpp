// How a camera moves and turns within one segment: speeds and their derivatives by finite differences.
#pragma once

#include <cstdint>
#include <vector>

#include "evaluation/camera_path.hpp"

namespace camdir::evaluation {

// Samples of all segments; map units, degrees, seconds.
struct MotionSamples {
    std::vector<double> acceleration;
    std::vector<double> jerk;
    std::vector<double> angular_speed;
    std::vector<double> angular_acceleration;
    double largest_rotation = 0.0;  // degrees between two frames
};

// Takes the cameras of one player in order and adds their motion to `samples`.
class MotionMeter {
  public:
    explicit MotionMeter(MotionSamples& samples) : samples_(samples) {}

    // The next camera does not belong to the segment of the one before.
    void end_segment() { length_ = 0; }

    // `time` in nanoseconds, ascending strictly.
    void add(std::int64_t time, const CameraSample& camera);

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

    MotionSamples& samples_;
    int length_ = 0;  // cameras of the segment so far
    State last_;
    double step_before_last_ = 0.0;
};

}  // namespace camdir::evaluation
