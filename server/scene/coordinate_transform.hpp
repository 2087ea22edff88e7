// From a source's coordinates to the map's: right-handed, z up, of a size that floats resolve.
#pragma once

#include "base/error.hpp"
#include "scene/read_options.hpp"
#include "scene/scene.hpp"

namespace camdir::scene {

class CoordinateTransform {
  public:
    // `up` is what the format says; the options win.
    CoordinateTransform(const ReadOptions& options, UpAxis up);

    [[nodiscard]] double metres_per_unit() const { return metres_per_unit_; }
    // Map units in a nominal unit.
    [[nodiscard]] double nominal_unit() const { return metres_of_nominal_unit / metres_per_unit_; }

    // Fails for positions that are not finite, or too far from the origin for floats to resolve a hundredth
    // of a nominal unit or so; `what` names the point.
    [[nodiscard]] Result<Vec3d> place(const Vec3d& source, const char* what, std::size_t index) const;

  private:
    double metres_per_unit_;
    UpAxis up_;
    Vec3d origin_;
};

}  // namespace camdir::scene
