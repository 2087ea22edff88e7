#include "camera_motion.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

namespace camdir::sdk {

namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

Vector3d position_of(const cdir_camera& camera) {
    return Eigen::Map<const Eigen::Vector3f>(camera.position).cast<double>();
}

Quaterniond orientation_of(const cdir_camera& camera) {
    return Eigen::Map<const Eigen::Quaternionf>(camera.orientation).cast<double>().normalized();
}

Vector3d rotation_vector(const Quaterniond& rotation) {
    const Eigen::AngleAxisd turn(rotation);  // 0 .. pi
    return turn.angle() * turn.axis();
}

Quaterniond rotation_by(const Vector3d& vector) {
    const double angle = vector.norm();
    return angle > 0.0 ? Quaterniond(Eigen::AngleAxisd(angle, vector / angle)) : Quaterniond::Identity();
}

Vector3d shortened(const Vector3d& vector, double limit) {
    const double norm = vector.norm();
    return norm > limit ? Vector3d(vector * (limit / norm)) : vector;
}

// Three times the slower velocity is the most with which a cubic does not pass its ends.
Vector3d between(const Vector3d& before, double before_seconds, const Vector3d& after, double after_seconds) {
    const double share = before_seconds / (before_seconds + after_seconds);
    return shortened(before + share * (after - before), 3.0 * std::min(before.norm(), after.norm()));
}

// Never turned back: as much is added to the last velocity as it has itself, at most.
Vector3d beyond(const Vector3d& before, double before_seconds, const Vector3d& last, double last_seconds) {
    const double share = last_seconds / (before_seconds + last_seconds);
    return last + shortened(share * (last - before), last.norm());
}

// Slope 1 at 0, value and slope 0 from `width` on. At most width * 4 / 27, at a third of the width.
double bump(double share, double width) {
    if (share >= width) return 0.0;
    const double rest = 1.0 - share / width;
    return share * rest * rest;
}

// How far a curve leaves the straight way at either end, by its velocity there: a cubic Hermite curve is the
// straight way and two bumps as wide as the way. Narrower ones keep the velocities at the ends.
struct Deviation {
    Vector3d start, end;  // velocity over the straight way's, times the way's duration
    double start_width = 1.0;
    double end_width = 1.0;

    [[nodiscard]] Vector3d at(double share) const {
        return bump(share, start_width) * start - bump(1.0 - share, end_width) * end;
    }
};

Deviation deviation(const Vector3d& way, const Vector3d& start, const Vector3d& end, double seconds) {
    return {start * seconds - way, end * seconds - way};
}

// Of a bump that lies in the ball at its end, and does not meet the other bump.
double narrow_width(double clearance, double distance, double deviation) {
    const double reach = distance + deviation * 4.0 / 27.0;
    const double radius = std::max(clearance, 0.0);
    return radius >= 0.5 * reach ? 0.5 : radius / reach;
}

// Let d be the length of the way, r and R the clearances at its ends, A and B the lengths of start and end.
//
// The way's point at share s has a clearance of at least max(r - s d, R - (1 - s) d), by the ball of its
// first or last frame. The least of that over all s is max((r + R - d) / 2, r - d, R - d). Bumps as wide as
// the way deviate by at most A s (1 - s)^2 + B s^2 (1 - s) <= max(A, B) s (1 - s) <= max(A, B) / 4. Where
// that is not more, the whole curve lies in the two balls.
//
// Otherwise the bumps are at most half as wide as the way. One of width w is nothing beyond w, and up to
// there the curve is at most w d + A w 4 / 27 from its first frame: within r, by the choice of w. So it is
// with R at the other end, and between both the curve is the straight way.
void keep_within_clearance(Deviation& deviation, double distance, double start_clearance,
                           double end_clearance) {
    const double least = std::max({(start_clearance + end_clearance - distance) / 2.0,
                                   start_clearance - distance, end_clearance - distance});
    const double start = deviation.start.norm(), end = deviation.end.norm();
    if (std::max(start, end) / 4.0 <= least) return;
    deviation.start_width = narrow_width(start_clearance, distance, start);
    deviation.end_width = narrow_width(end_clearance, distance, end);
}

// Of the balls around both frames. A float cannot hold every difference of two.
float clearance_at(const Vector3d& position, const cdir_camera& a, const cdir_camera& b) {
    const double clearance = std::max(a.clearance - (position - position_of(a)).norm(),
                                      b.clearance - (position - position_of(b)).norm());
    return static_cast<float>(std::max<double>(clearance, std::numeric_limits<float>::lowest()));
}

}  // namespace

CameraStep step_between(const cdir_camera& a, const cdir_camera& b, double seconds) {
    const Vector3d turn = rotation_vector(orientation_of(a).conjugate() * orientation_of(b));
    return {seconds, {(position_of(b) - position_of(a)) / seconds, turn / seconds}};
}

CameraVelocity velocity_between(const CameraStep& before, const CameraStep& after) {
    return {between(before.velocity.linear, before.seconds, after.velocity.linear, after.seconds),
            between(before.velocity.angular, before.seconds, after.velocity.angular, after.seconds)};
}

CameraVelocity velocity_after(const CameraStep& before, const CameraStep& last) {
    return {beyond(before.velocity.linear, before.seconds, last.velocity.linear, last.seconds),
            beyond(before.velocity.angular, before.seconds, last.velocity.angular, last.seconds)};
}

cdir_camera camera_between(const CameraState& a, const CameraState& b, double seconds, double share) {
    const CameraVelocity step = step_between(a.camera, b.camera, seconds).velocity;
    const Vector3d way = seconds * step.linear, turn = seconds * step.angular;
    Deviation moved = deviation(way, a.velocity.linear, b.velocity.linear, seconds);
    keep_within_clearance(moved, way.norm(), a.camera.clearance, b.camera.clearance);
    const Deviation turned = deviation(turn, a.velocity.angular, b.velocity.angular, seconds);

    const Vector3d position = position_of(a.camera) + share * way + moved.at(share);
    const Quaterniond orientation =
        orientation_of(a.camera) * rotation_by(share * turn) * rotation_by(turned.at(share));
    cdir_camera camera = a.camera;
    Eigen::Map<Eigen::Vector3f>(camera.position) = position.cast<float>();
    Eigen::Map<Eigen::Quaternionf>(camera.orientation) = orientation.cast<float>().normalized();
    camera.vertical_fov += static_cast<float>(share) * (b.camera.vertical_fov - a.camera.vertical_fov);
    camera.clearance = clearance_at(position, a.camera, b.camera);
    return camera;
}

}  // namespace camdir::sdk
