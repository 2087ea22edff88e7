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

    // Fails for positions that are not finite, or at 2^20 nominal units or more from the origin, where single
    // precision resolves no more than 1/16 of one; `what` and `index` name the point.
    [[nodiscard]] Result<Vec3d> place(const Vec3d& source, const char* what, std::size_t index) const;

    // Likewise for what was read in single precision: the limit holds before the origin is subtracted too.
    [[nodiscard]] Result<Vec3d> place_single(const Vec3d& source, const char* what, std::size_t index) const;

  private:
    [[nodiscard]] double limit() const;

    double metres_per_unit_;
    UpAxis up_;
    Vec3d origin_;
};

}  // namespace camdir::scene
