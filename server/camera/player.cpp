#include "camera/player.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "camera/view.hpp"
#include "camera/window.hpp"

namespace camdir::camera {
namespace {

constexpr float velocity_smoothing = 0.03F;     // s: two frames of 60 Hz
constexpr float horizontal_persistence = 0.5F;  // s: how long players keep running
constexpr float vertical_persistence = 0.15F;   // s: how long they keep rising or falling
constexpr float turn_persistence = 0.08F;       // s: how long they keep turning
constexpr float inside_surface = 0.9F;          // share of a ball's radius that is surely inside its slab

Vec3f view_direction(const Pose& pose) {
    return pose.orientation.normalized() * Vec3f::UnitX();
}

float smoothing_share(float dt, float time_constant) {
    return time_constant > 0.0F ? 1.0F - std::exp(-dt / time_constant) : 1.0F;
}

// `from` rotated towards `to` by `share` of the angle between them. Opposite directions turn horizontally
// where they can.
Vec3f rotated_towards(const Vec3f& from, const Vec3f& to, float share) {
    const float angle = angle_between(from, to);
    Vec3f axis = from.cross(to);
    if (axis.squaredNorm() < 1e-12F) {
        if (angle < 1.0F) return to;
        axis =
            std::abs(from.z()) < 0.9F ? Vec3f(from.cross(Vec3f::UnitZ()).cross(from)) : from.unitOrthogonal();
    }
    return (Eigen::AngleAxisf(angle * share, axis.normalized()) * from).normalized();
}

// The rotation vector from one direction to another; zero between opposite ones, which have none of their
// own.
Vec3f rotation_between(const Vec3f& from, const Vec3f& to) {
    const Vec3f axis = from.cross(to);
    const float sine = axis.norm();
    return sine > 1e-6F ? Vec3f(axis * (angle_between(from, to) / sine)) : Vec3f::Zero();
}

void settle(const freespace::Space& space, const Vec3f& anchor, PlayerTrack& track) {
    const freespace::Distance found = freespace::distance(space, anchor);
    if (!found.covered()) return;
    track.anchor = anchor;
    track.slab = found.triangle;
    track.clearance = found.value;
}

// Out of the mover that is over the anchor, if there is room beside it.
void leave_mover(const freespace::Space& space, const MapProfile& profile, PlayerTrack& track) {
    const freespace::MoverDistance over = space.mover_distance(track.anchor, 0.0F);
    if (over.mover == freespace::none) return;
    settle(space, track.anchor + (profile.minimum_clearance - over.value) * over.way_out, track);
}

// The point of the representation's balls at its vertices that is nearest to `point`; `point` itself when
// there is no ball.
Vec3f nearest_free_point(const freespace::Space& space, const Vec3f& point) {
    Vec3f nearest = point;
    float least = std::numeric_limits<float>::infinity();
    const auto vertices = space.map().vertices();
    for (std::uint32_t i = 0; i < vertices.size(); ++i) {
        const float radius = vertices[i].free_distance;
        if (radius <= 0.0F || space.map().incident(i).empty()) continue;
        const Vec3f offset = point - vertices[i].position();
        const float gap = offset.norm() - radius;
        if (gap >= least) continue;
        least = gap;
        const float reach = std::min(1.0F, inside_surface * radius / std::max(offset.norm(), 1e-6F));
        nearest = vertices[i].position() + reach * offset;
    }
    return nearest;
}

}  // namespace

void restart(const freespace::Space& space, const MapProfile& profile, const Pose& pose, PlayerTrack& track) {
    track = PlayerTrack();
    track.eye = pose.eye;
    track.anchor = pose.eye;
    track.velocity = plausible(pose.velocity, profile.unit);
    track.heading = view_direction(pose);
    track.view = track.heading;
    settle(space, pose.eye, track);
    track.covered = track.slab != freespace::none;
    if (!track.covered) settle(space, nearest_free_point(space, pose.eye), track);
    if (track.slab == freespace::none) leave_mover(space, profile, track);
}

void follow(const freespace::Space& space, const MapProfile& profile, const Pose& pose, float dt,
            PlayerTrack& track) {
    const Vec3f before = track.anchor;
    const Vec3f velocity = plausible((pose.eye - track.eye) / dt, profile.unit);
    track.velocity += smoothing_share(dt, velocity_smoothing) * (velocity - track.velocity);
    track.eye = pose.eye;
    const Vec3f view = view_direction(pose);
    track.turning +=
        smoothing_share(dt, velocity_smoothing) * (rotation_between(track.view, view) / dt - track.turning);
    track.view = view;
    track.heading = rotated_towards(track.heading, view, smoothing_share(dt, profile.heading_smoothing));

    const freespace::Distance found = freespace::distance(space, pose.eye);
    track.covered = found.covered();
    if (track.covered) {
        track.anchor = pose.eye;
        track.slab = found.triangle;
        track.clearance = found.value;
    } else {
        const freespace::Sight way = freespace::sight(space, track.anchor, pose.eye);
        const Vec3f direction = (pose.eye - track.anchor).normalized();
        settle(space, track.anchor + inside_surface * way.free_length * direction, track);
        if (way.free_length == 0.0F) leave_mover(space, profile, track);
    }
    track.move = track.anchor - before;
}

Vec3f predicted_heading(const PlayerTrack& track, float ahead) {
    const Vec3f rotation = track.turning * turn_persistence * (1.0F - std::exp(-ahead / turn_persistence));
    const float angle = rotation.norm();
    if (!(angle > 1e-6F)) return track.heading;
    return Eigen::AngleAxisf(angle, rotation / angle) * track.heading;
}

Vec3f predicted_anchor(const freespace::Space& space, const MapProfile& profile, const PlayerTrack& track) {
    const auto travel = [&](float persistence) {
        return persistence * (1.0F - std::exp(-profile.prediction / persistence));
    };
    const Vec3f times(travel(horizontal_persistence), travel(horizontal_persistence),
                      travel(vertical_persistence));
    const Vec3f way = track.velocity.cwiseProduct(times);
    const float length = way.norm();
    if (!(length > 1e-3F)) return track.anchor;
    const freespace::Sight free = freespace::sight(space, track.anchor, track.anchor + way);
    return track.anchor + way * (inside_surface * std::min(free.free_length, length) / length);
}

}  // namespace camdir::camera
