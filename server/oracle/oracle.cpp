#include "oracle/oracle.hpp"

#include <cassert>
#include <mutex>
#include <optional>

#include "oracle/points.hpp"
#include "oracle/reached_grid.hpp"
#include "oracle/surfaces.hpp"
#include "oracle/volumes.hpp"

namespace camdir::oracle {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr int max_climbs = 32;

}  // namespace

struct Oracle::Structures {
    Structures(const scene::Scene& scene, double point_radius)
        : device(make_device()),
          surfaces(device.get(), scene),
          points(device.get(), scene, point_radius),
          volumes(device.get(), scene),
          bounds(scene.bounds),
          // Between the points of a cloud the passages are narrower.
          pitch(scene.points.empty() ? grid_pitch(scene) : grid_pitch(scene) / 2.0),
          seeds(spawn_eyes(scene)) {}

    [[nodiscard]] Nearest nearest(const Vec3d& point, double limit) const {
        const Nearest surface = surfaces.nearest(point, limit);
        const Nearest ball = points.nearest(point, limit);
        return ball.distance < surface.distance ? ball : surface;
    }

    Device device;
    Surfaces surfaces;
    Points points;
    Volumes volumes;
    Box3d bounds;
    double pitch;
    std::vector<Vec3d> seeds;
    std::once_flag explored;
    std::optional<ReachedGrid> grid;
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
    return depth >= 0.0 ? -depth : structures_->nearest(point, limit).distance;
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
    return centre.allFinite() && structures_->nearest(centre, radius).distance == infinity &&
           structures_->volumes.ball_clear(centre, radius);
}

// A point in a corner sees no centre of the grid: it climbs away from the nearest obstacle, each time
// within its own free ball, until it does.
bool Oracle::reachable(const Vec3d& point) const {
    if (!point.allFinite() || in_solid(point)) return false;
    std::call_once(structures_->explored, [&] {
        // Neighbouring centres with more than half a pitch of clearance see each other.
        structures_->grid.emplace(*this, structures_->bounds, structures_->seeds, structures_->pitch,
                                  structures_->pitch / 2.0);
    });
    Vec3d place = point;
    for (int climb = 0; climb < max_climbs; ++climb) {
        if (structures_->grid->joined(place)) return true;
        const Nearest nearest = structures_->nearest(place, infinity);
        if (nearest.distance == infinity || nearest.distance <= 0.0) return false;
        place += (place - nearest.point).normalized() * (0.5 * nearest.distance);
    }
    return false;
}

}  // namespace camdir::oracle
