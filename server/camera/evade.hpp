// Out of the way of movers: what becomes of a place in the next moment, and where to go when one comes.
#pragma once

#include <optional>

#include "freespace/space.hpp"

namespace camdir::camera {

// `clearance`, or what movers leave of it at the time of the space and in the quarter of a second after; not
// positive where one comes over the place.
[[nodiscard]] float room_soon(const freespace::Space& space, const Vec3f& place, float clearance);

// Whether the camera cannot keep its place in the step of the space: a mover comes nearer than `clearance`,
// or through it.
[[nodiscard]] bool is_threatened(const freespace::Space& space, const Vec3f& place, float clearance);

// The nearest of some places around, at most `limit` away, which the camera can come to in the step and where
// it has `clearance` for the next moment, or else the one where it has most; its own place, if no other one
// has more. None where every way leads through a mover.
[[nodiscard]] std::optional<Vec3f> evade(const freespace::Space& space, const Vec3f& place, float clearance,
                                         float limit);

// The place that a mover which is nearer than `clearance` pushes the camera to in the step: ahead of it. Its
// own place without one.
[[nodiscard]] Vec3f pushed(const freespace::Space& space, const Vec3f& place, float clearance);

}  // namespace camdir::camera
