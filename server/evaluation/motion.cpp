#include "evaluation/motion.hpp"

#include <cassert>
#include <cmath>
#include <numbers>

#include "evaluation/picture.hpp"

namespace camdir::evaluation {
namespace {

constexpr std::int64_t sweep_window = 1'000'000'000;  // ns

// The rotation vector of `to` * `from`^-1 in degrees: its axis times its angle.
Vec3d rotation_between(const Eigen::Quaterniond& from, const Eigen::Quaterniond& to) {
    Eigen::Quaterniond turn = to * from.conjugate();
    if (turn.w() < 0.0) turn.coeffs() = -turn.coeffs();
    const double sine = turn.vec().norm();
    if (sine == 0.0) return Vec3d::Zero();
    const double angle = 2.0 * std::atan2(sine, turn.w());
    return turn.vec() * (angle / sine * 180.0 / std::numbers::pi);
}

double turn_of_axis(const Eigen::Quaterniond& from, const Eigen::Quaterniond& to) {
    return degrees_between(from * Vec3d::UnitX(), to * Vec3d::UnitX());
}

}  // namespace

double MotionMeter::sweep_speed(std::int64_t time, double degrees) {
    if (sweep_.empty()) sweep_.push_back({last_.time, 0.0});
    while (sweep_.size() > 1 && sweep_.front().time < time - sweep_window)
        sweep_.pop_front();
    const Sweep now{time, sweep_.back().degrees + degrees};
    const Sweep& begin = sweep_.front();
    const double speed = (now.degrees - begin.degrees) / (static_cast<double>(time - begin.time) * 1e-9);
    sweep_.push_back(now);
    return speed;
}

Motion MotionMeter::add(std::int64_t time, const CameraSample& camera) {
    Motion motion;
    State now;
    now.time = time;
    now.position = camera.position;
    now.orientation = camera.orientation;
    if (length_ >= 1) {
        assert(time > last_.time);
        now.step = static_cast<double>(time - last_.time) * 1e-9;
        const Vec3d rotation = rotation_between(last_.orientation, now.orientation);
        now.velocity = (now.position - last_.position) / now.step;
        now.angular_velocity = rotation / now.step;
        motion.rotation = rotation.norm();
        motion.angular_speed = now.angular_velocity.norm();
        const double sweep = sweep_speed(time, turn_of_axis(last_.orientation, now.orientation));
        motion.comfortable = motion.angular_speed <= comfortable_turn && sweep < comfortable_sweep;
    }
    if (length_ >= 2) {
        const double span = (now.step + last_.step) / 2.0;
        now.acceleration = (now.velocity - last_.velocity) / span;
        motion.acceleration = now.acceleration.norm();
        motion.angular_acceleration = (now.angular_velocity - last_.angular_velocity).norm() / span;
    }
    if (length_ >= 3) {
        const double span = (now.step + 2.0 * last_.step + step_before_last_) / 4.0;
        motion.jerk = (now.acceleration - last_.acceleration).norm() / span;
    }
    step_before_last_ = last_.step;
    last_ = now;
    ++length_;
    return motion;
}

}  // namespace camdir::evaluation
