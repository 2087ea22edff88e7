#include "bench/cameras/chase.hpp"

#include <algorithm>

#include "bench/cameras/view_angles.hpp"

namespace camdir::bench {
namespace {

constexpr double turn_speed = 180.0;  // degrees/s
constexpr double recovery = 32.0;     // units of 0.0254 m a second
constexpr double half_hull = 6.0;     // units of 0.0254 m

double turned(double angle, double goal, double seconds) {
    const double most = turn_speed * seconds;
    return angle + std::clamp(turn_between(angle, goal), -most, most);
}

class HltvChase {
  public:
    HltvChase(const BulletQueries& bullet, double unit) : bullet_(bullet), unit_(unit) {}

    evaluation::CameraSample operator()(const evaluation::TracePose& pose, double seconds) {
        const double full = desired_distance * unit_;
        const ViewAngles goal = view_angles(pose);
        if (pose.discontinuity) {
            angles_ = goal;
            distance_ = full;
        }
        angles_ = {turned(angles_.yaw, goal.yaw, seconds), turned(angles_.pitch, goal.pitch, seconds)};
        distance_ = std::min(full, distance_ + recovery * unit_ * seconds);
        const Eigen::Quaterniond orientation = orientation_of(angles_);
        const Vec3d forward = orientation * Vec3d::UnitX();
        const Vec3d end = pose.eye - distance_ * forward;
        distance_ *= bullet_.sweep_cube(pose.eye.cast<float>(), end.cast<float>(),
                                        static_cast<float>(half_hull * unit_));
        return {pose.eye - distance_ * forward, orientation, pose.discontinuity};
    }

  private:
    const BulletQueries& bullet_;
    double unit_;
    ViewAngles angles_;
    double distance_ = 0.0;  // map units
};

}  // namespace

Camera hltv_chase(const BulletQueries& bullet, double unit) {
    return {"HLTV chase", [&bullet, unit] { return HltvChase(bullet, unit); }};
}

}  // namespace camdir::bench
