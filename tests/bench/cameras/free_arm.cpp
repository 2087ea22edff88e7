#include "bench/cameras/free_arm.hpp"

#include <algorithm>
#include <cmath>

#include "bench/cameras/camera.hpp"

namespace camdir::bench {
namespace {

constexpr double half_side = 6.0;  // units of 0.0254 m, as below
constexpr double padding = 6.0;
constexpr double growth_rate = 10.0;  // 1/s

}  // namespace

double free_arm(const EmbreeQueries& embree, const Vec3d& eye, const Eigen::Quaterniond& orientation,
                double unit) {
    const double reach = (desired_distance + padding) * unit;
    const Vec3d end = eye - reach * (orientation * Vec3d::UnitX());
    const Vec3d left = half_side * unit * (orientation * Vec3d::UnitY());
    const Vec3d up = half_side * unit * (orientation * Vec3d::UnitZ());
    double free = 1.0;
    for (const Vec3d& goal : {end, Vec3d(end + left + up), Vec3d(end + left - up), Vec3d(end - left + up),
                              Vec3d(end - left - up)})
        free = std::min(free, static_cast<double>(embree.cast(eye.cast<float>(), goal.cast<float>())));
    return std::max(free * reach - padding * unit, 0.0);
}

double eased(double length, double free, double seconds) {
    if (free <= length) return free;
    return length + (free - length) * (1.0 - std::exp(-growth_rate * seconds));
}

}  // namespace camdir::bench
