#include "bench/cameras/spring_arm.hpp"

#include <algorithm>
#include <cmath>

#include "bench/cameras/free_arm.hpp"

namespace camdir::bench {
namespace {

constexpr double sphere_radius = 12.0;

Vec3d forward_of(const evaluation::TracePose& pose) {
    return pose.orientation * Vec3d::UnitX();
}

class SweptArm {
  public:
    SweptArm(const BulletQueries& bullet, double lag, double unit)
        : bullet_(bullet), lag_(lag), length_(desired_distance * unit), radius_(sphere_radius * unit) {}

    evaluation::CameraSample operator()(const evaluation::TracePose& pose, double seconds) {
        const double share = pose.discontinuity || lag_ == 0.0 ? 1.0 : std::min(lag_ * seconds, 1.0);
        origin_ += share * (pose.eye - origin_);
        const Vec3d end = origin_ - length_ * forward_of(pose);
        const double free =
            bullet_.sweep(pose.eye.cast<float>(), end.cast<float>(), static_cast<float>(radius_));
        return {pose.eye + free * (end - pose.eye), pose.orientation, pose.discontinuity};
    }

  private:
    const BulletQueries& bullet_;
    double lag_;
    double length_;
    double radius_;
    Vec3d origin_ = Vec3d::Zero();  // what the arm is fixed to
};

class RayArm {
  public:
    RayArm(const EmbreeQueries& embree, double unit) : embree_(embree), unit_(unit) {}

    evaluation::CameraSample operator()(const evaluation::TracePose& pose, double seconds) {
        const double free = free_arm(embree_, pose.eye, pose.orientation, unit_);
        length_ = pose.discontinuity ? free : eased(length_, free, seconds);
        return {pose.eye - length_ * forward_of(pose), pose.orientation, pose.discontinuity};
    }

  private:
    const EmbreeQueries& embree_;
    double unit_;
    double length_ = 0.0;
};

}  // namespace

Camera swept_arm(const BulletQueries& bullet, double lag, double unit) {
    return {lag > 0.0 ? "spring arm by sweep with lag" : "spring arm by sweep",
            [&bullet, lag, unit] { return SweptArm(bullet, lag, unit); }};
}

Camera ray_arm(const EmbreeQueries& embree, double unit) {
    return {"spring arm by rays", [&embree, unit] { return RayArm(embree, unit); }};
}

}  // namespace camdir::bench
