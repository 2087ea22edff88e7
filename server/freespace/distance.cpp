#include "freespace/distance.hpp"

#include "base/round_down.hpp"
#include "freespace/search.hpp"

namespace camdir::freespace {
namespace {

Distance distance_at(const Freespace& freespace, const Vec3f& point, const SlabPoint& best) {
    if (best.triangle == none) return {};
    const Ball ball = ball_at(freespace.mesh(), best);
    const double value = ball.radius - (point.cast<double>() - ball.centre).norm();
    if (!(value > 0.0)) return {};
    return {round_down(value), best.triangle};
}

}  // namespace

Distance distance(const Freespace& freespace, const Vec3f& point, std::uint32_t previous) {
    if (!point.allFinite()) return {};
    SlabPoint best = uncovered;
    improve_by_hints(freespace.mesh(), point, previous, best);
    if (best.triangle != none && previous < freespace.triangles().size())
        improve_by_ring(freespace, point, best.triangle, best);
    if (best.triangle == none) improve_everywhere(freespace.mesh(), point, Effort{}, best);
    return distance_at(freespace, point, best);
}

Distance distance_everywhere(const Freespace& freespace, const Vec3f& point) {
    if (!point.allFinite()) return {};
    SlabPoint best = uncovered;
    improve_by_hints(freespace.mesh(), point, none, best);
    improve_everywhere(freespace.mesh(), point, Effort{}, best);
    return distance_at(freespace, point, best);
}

}  // namespace camdir::freespace
