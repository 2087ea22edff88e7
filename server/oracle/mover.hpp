// What moves, at one of its places: by its planes alone, in double precision.
#pragma once

#include "base/geometry.hpp"
#include "scene/scene.hpp"

namespace camdir::oracle {

// Where a mover is: it is rotated about its own origin, then moved to the position.
struct Placement {
    Vec3d position = Vec3d::Zero();
    Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  // length 1

    // The point in the mover's frame.
    [[nodiscard]] Vec3d local(const Vec3d& point) const {
        return orientation.conjugate() * (point - position);
    }
};

// A solid part of the mover touches the closed segment, in the mover's frame; both ends may be one point.
// Where the ends are the places of a point at two times, each in the frame as it is then, that is whether
// mover and point meet on the way: exactly for a mover that does not turn.
[[nodiscard]] bool touches(const scene::Mover& mover, const Vec3d& from, const Vec3d& to);

}  // namespace camdir::oracle
