#include "oracle/oracle.hpp"

#include <algorithm>
#include <cassert>

#include "oracle/points.hpp"
#include "oracle/surfaces.hpp"
#include "oracle/volumes.hpp"

namespace camdir::oracle {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace

struct Oracle::Structures {
    Structures(const scene::Scene& scene, double point_radius)
        : device(make_device()),
          surfaces(device.get(), scene),
          points(device.get(), scene, point_radius),
          volumes(device.get(), scene) {}

    Device device;
    Surfaces surfaces;
    Points points;
    Volumes volumes;
};

Oracle::Oracle(const scene::Scene& scene, double point_radius)
    : structures_(std::make_unique<Structures>(scene, point_radius)) {
    assert(scene.points.empty() || point_radius > 0.0);
}
Oracle::Oracle(Oracle&&) noexcept = default;
Oracle& Oracle::operator=(Oracle&&) noexcept = default;
Oracle::~Oracle() = default;

double Oracle::clearance(const Vec3d& point, double limit) const {
    if (!point.allFinite()) return -infinity;
    const double depth = structures_->volumes.depth(point);
    return depth >= 0.0 ? -depth : nearest(point, limit).distance;
}

Nearest Oracle::nearest(const Vec3d& point, double limit) const {
    const Nearest surface = structures_->surfaces.nearest(point, limit);
    const Nearest ball = structures_->points.nearest(point, limit);
    return ball.distance < surface.distance ? ball : surface;
}

bool Oracle::segment_clear(const Vec3d& from, const Vec3d& to) const {
    const double largest = std::max(from.cwiseAbs().maxCoeff(), to.cwiseAbs().maxCoeff());
    return end_clear(from, largest) && end_clear(to, largest) && between_clear(from, to);
}

bool Oracle::end_clear(const Vec3d& end, double largest) const {
    return end.allFinite() && structures_->surfaces.end_clear(end, largest);
}

bool Oracle::between_clear(const Vec3d& from, const Vec3d& to) const {
    return structures_->surfaces.between_clear(from, to) && structures_->points.segment_clear(from, to);
}

bool Oracle::in_solid(const Vec3d& point) const {
    return structures_->volumes.depth(point) >= 0.0 ||
           structures_->points.nearest(point, 0.0).distance <= 0.0;
}

bool Oracle::ball_clear(const Vec3d& centre, double radius) const {
    return centre.allFinite() && nearest(centre, radius).distance == infinity &&
           structures_->volumes.ball_clear(centre, radius);
}

}  // namespace camdir::oracle
