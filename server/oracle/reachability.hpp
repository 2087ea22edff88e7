// Which points are joined to the spawn points by free space: not outside the sealed map.
#pragma once

#include "oracle/reached_grid.hpp"

namespace camdir::oracle {

// Immutable; const members are thread-safe. The oracle must outlive it.
class Reachability {
  public:
    // Fails as ReachedGrid::explore.
    [[nodiscard]] static Result<Reachability> explore(const Oracle& oracle, const scene::Scene& scene,
                                                      const ExploreProgress& progress,
                                                      const std::stop_token& stop);

    // `point` is in no solid, and free space joins it to a spawn point. True is proved by a chain of
    // overlapping free balls and free segments; false may be wrong for a point in a crack narrower than
    // 8 units of 0.0254 m (4 in a cloud). False for points that are not finite.
    [[nodiscard]] bool reachable(const Vec3d& point) const;

  private:
    Reachability(const Oracle& oracle, ReachedGrid grid) : oracle_(&oracle), grid_(std::move(grid)) {}

    const Oracle* oracle_;
    ReachedGrid grid_;
};

}  // namespace camdir::oracle
