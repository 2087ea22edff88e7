// How long an arm behind the eye can be.
#pragma once

#include "base/geometry.hpp"
#include "bench/queries/embree_queries.hpp"

namespace camdir::bench {

// At most the desired distance, map units: 6 units less than the first of five rays goes, of which one leads
// from the eye straight against the direction of view and the others to the corners of a square of 12 units
// round its end. `unit`: map units of 0.0254 m.
[[nodiscard]] double free_arm(const EmbreeQueries& embree, const Vec3d& eye,
                              const Eigen::Quaterniond& orientation, double unit);

// The length of an arm `seconds` after it was `length` long: it shortens to `free` at once and grows towards
// it by a share of 1 - exp(-10 seconds).
[[nodiscard]] double eased(double length, double free, double seconds);

}  // namespace camdir::bench
