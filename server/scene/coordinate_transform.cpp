#include "scene/coordinate_transform.hpp"

#include <algorithm>
#include <sstream>

namespace camdir::scene {
namespace {

constexpr double max_nominal_coordinate = 1 << 20;
// Half of what a MAP.vfs holds: the mesh may reach out around the geometry.
constexpr double file_coordinate_limit = 5e7;

std::string text_of(const Vec3d& p) {
    std::ostringstream text;
    text.precision(12);
    text << '(' << p.x() << ", " << p.y() << ", " << p.z() << ')';
    return text.str();
}

}  // namespace

CoordinateTransform::CoordinateTransform(const ReadOptions& options, UpAxis up)
    : metres_per_unit_(options.metres_per_unit.value_or(1.0)),
      up_(options.up.value_or(up)),
      origin_(options.origin) {}

Result<Vec3d> CoordinateTransform::place(const Vec3d& source, const char* what, std::size_t index) const {
    const Vec3d moved = source - origin_;
    const double limit = std::min(max_nominal_coordinate * nominal_unit(), file_coordinate_limit);
    if (!(moved.cwiseAbs().maxCoeff() < limit) || !moved.allFinite()) {
        std::ostringstream text;
        text << what << ' ' << index << " at " << text_of(source) << ": expected finite coordinates below "
             << limit << " map units; `--metres-per-unit` says how long a unit is, `--origin` moves what "
             << "lies far from (0, 0, 0)";
        return fail(text.str());
    }
    if (up_ == UpAxis::y) return Vec3d(moved.z(), moved.x(), moved.y());
    return moved;
}

}  // namespace camdir::scene
