// Exact clearance and visibility against the source scene. It never looks at a VFS-rep: verify, evaluate
// and the tests judge with it.
#pragma once

#include <memory>

#include "base/geometry.hpp"
#include "scene/scene.hpp"

namespace camdir::oracle {

// Immutable after construction; all const members are thread-safe.
class Oracle {
  public:
    explicit Oracle(const scene::Scene& scene);
    Oracle(Oracle&&) noexcept;
    Oracle& operator=(Oracle&&) noexcept;
    ~Oracle();

    // Distance from `point` to the nearest obstacle triangle, map units; inside a solid brush the
    // negative depth below the brush's surface.
    [[nodiscard]] double clearance(const Vec3d& point) const;

    // No obstacle triangle crosses or touches the closed segment.
    [[nodiscard]] bool segment_clear(const Vec3d& from, const Vec3d& to) const;

    // Inside a brush, by the brushes' planes alone; always false for scenes without brushes.
    [[nodiscard]] bool in_solid(const Vec3d& point) const;

    // In no solid, and joined to a spawn point by free space: not outside the sealed map.
    [[nodiscard]] bool reachable(const Vec3d& point) const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace camdir::oracle
