#include "freespace/distance.hpp"

#include "base/round_down.hpp"
#include "freespace/slab_octree.hpp"

namespace camdir::freespace {

Distance distance(const Freespace& freespace, const Vec3f& point) {
    if (!point.allFinite()) return {};
    const SlabPoint best = freespace.octree().best(point);
    if (best.triangle == none) return {};
    const Ball ball = freespace.octree().ball(best);
    const double value = ball.radius - (point.cast<double>() - ball.centre).norm();
    if (!(value > 0.0)) return {};
    return {round_down(value), best.triangle};
}

}  // namespace camdir::freespace
