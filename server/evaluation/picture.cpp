#include "evaluation/picture.hpp"

#include <cmath>

namespace camdir::evaluation {

bool in_picture(const CameraSample& camera, const Vec3d& point, double share) {
    const Vec3d seen = camera.orientation.conjugate() * (point - camera.position);
    const double half_height = share * 9.0 / 16.0;
    return seen.x() >= 0.0 && std::abs(seen.y()) <= share * seen.x() &&
           std::abs(seen.z()) <= half_height * seen.x();
}

Box3d player_box(const TracePose& pose, double unit) {
    const double top = pose.view_height < 20.0 * unit ? 16.0 : 32.0;
    return {pose.origin() + unit * Vec3d(-15.0, -15.0, -24.0), pose.origin() + unit * Vec3d(15.0, 15.0, top)};
}

double degrees_between(const Vec3d& a, const Vec3d& b) {
    if (a.isZero(0.0) || b.isZero(0.0)) return 0.0;
    return std::atan2(a.cross(b).norm(), a.dot(b)) / radians_of_a_degree<double>;
}

}  // namespace camdir::evaluation
