#include "scene/coordinate_transform.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace camdir::scene {
namespace {

constexpr double max_nominal_coordinate = 1 << 20;
// Half of what a MAP.vfs holds: the mesh may reach out around the geometry.
constexpr double file_coordinate_limit = 5e7;

std::string triple(const Vec3d& p) {
    std::ostringstream text;
    text.precision(12);
    text << '(' << p.x() << ", " << p.y() << ", " << p.z() << ')';
    return text.str();
}

bool is_within(const Vec3d& point, double limit) {
    return point.allFinite() && point.cwiseAbs().maxCoeff() < limit;
}

// From a number in single precision to the next.
double step_of(double coordinate) {
    const auto single = static_cast<float>(coordinate);
    return std::nextafter(single, std::numeric_limits<float>::infinity()) - single;
}

}  // namespace

CoordinateTransform::CoordinateTransform(const ReadOptions& options, UpAxis up)
    : metres_per_unit_(options.metres_per_unit.value_or(1.0)),
      up_(options.up.value_or(up)),
      origin_(options.origin) {}

double CoordinateTransform::limit() const {
    return std::min(max_nominal_coordinate * nominal_unit(), file_coordinate_limit);
}

Result<Vec3d> CoordinateTransform::place(const Vec3d& source, const char* what, std::size_t index) const {
    const Vec3d moved = source - origin_;
    if (!is_within(moved, limit())) {
        std::ostringstream text;
        text << what << ' ' << index << " at " << triple(source) << ": expected finite coordinates below "
             << limit() << " map units; `--metres-per-unit` says how long a unit is, `--origin` moves what "
             << "lies far from (0, 0, 0)";
        return fail(text.str());
    }
    if (up_ == UpAxis::y) return Vec3d(moved.z(), moved.x(), moved.y());
    return moved;
}

Result<Vec3d> CoordinateTransform::place_single(const Vec3d& source, const char* what,
                                                std::size_t index) const {
    // Without an origin place() says what to do.
    if (origin_ != Vec3d::Zero() && !is_within(source, limit())) {
        std::ostringstream text;
        text << what << ' ' << index << " at " << triple(source) << " is in single precision, in steps of "
             << step_of(source.cwiseAbs().maxCoeff()) << " map units there; expected coordinates below "
             << limit()
             << ": subtract the origin in the program that wrote the file, or write OBJ, or PLY as "
             << "text or doubles, which are read in double precision";
        return fail(text.str());
    }
    return place(source, what, index);
}

}  // namespace camdir::scene
