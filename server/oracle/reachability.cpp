#include "oracle/reachability.hpp"

#include <cmath>

namespace camdir::oracle {

Result<Reachability> Reachability::explore(const Oracle& oracle, const scene::Scene& scene,
                                           const ExploreProgress& progress, const std::stop_token& stop) {
    // Between the points of a cloud the passages are narrower.
    const double pitch = scene.points.empty() ? grid_pitch(scene) : grid_pitch(scene) / 2.0;
    // Neighbouring centres with more than half a pitch of clearance see each other.
    auto grid = ReachedGrid::explore(oracle, scene, pitch, pitch / 2.0, progress, stop);
    if (!grid) return tl::unexpected(std::move(grid.error()));
    return Reachability(oracle, std::move(*grid));
}

// A point in a corner sees no centre of the grid: it climbs away from the nearest obstacle, each time
// within its own free ball, until it does.
bool Reachability::reachable(const Vec3d& point) const {
    constexpr int max_climbs = 32;
    if (!point.allFinite() || oracle_->in_solid(point)) return false;
    Vec3d place = point;
    for (int climb = 0; climb < max_climbs; ++climb) {
        if (grid_.joined(place)) return true;
        const Nearest nearest = oracle_->nearest(place);
        if (std::isinf(nearest.distance) || nearest.distance <= 0.0) return false;
        place += (place - nearest.point).normalized() * (0.5 * nearest.distance);
    }
    return false;
}

}  // namespace camdir::oracle
