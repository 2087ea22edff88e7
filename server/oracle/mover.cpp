#include "oracle/mover.hpp"

#include <algorithm>

namespace camdir::oracle {
namespace {

bool touches(const scene::ConvexPart& part, const Vec3d& from, const Vec3d& to) {
    if (!part.bounds.intersects(Box3d(from.cwiseMin(to), from.cwiseMax(to)))) return false;
    double first = 0.0, last = 1.0;  // what is behind all planes so far, as shares of the way
    for (const scene::Plane& plane : part.planes) {
        const double start = plane.normal.dot(from) - plane.distance;
        const double end = plane.normal.dot(to) - plane.distance;
        if (start > 0.0 && end > 0.0) return false;
        if (start > 0.0) first = std::max(first, start / (start - end));
        if (end > 0.0) last = std::min(last, start / (start - end));
    }
    return first <= last;
}

}  // namespace

bool touches(const scene::Mover& mover, const Vec3d& from, const Vec3d& to) {
    return std::any_of(mover.parts.begin(), mover.parts.end(),
                       [&](const scene::ConvexPart& part) { return touches(part, from, to); });
}

}  // namespace camdir::oracle
