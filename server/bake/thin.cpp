#include "bake/thin.hpp"

#include <algorithm>
#include <tuple>

#include "base/parallel.hpp"
#include "base/point_grid.hpp"

namespace camdir::bake {

Result<std::vector<Vec3d>> thin(std::vector<Vec3d> points, double distance, Stage& stage) {
    for (Vec3d& point : points)
        point += Vec3d::Zero();  // -0 becomes 0, so that equal points are identical
    parallel_sort(points.begin(), points.end(), [](const Vec3d& a, const Vec3d& b) {
        return std::tuple(a.x(), a.y(), a.z()) < std::tuple(b.x(), b.y(), b.z());
    });
    points.erase(std::unique(points.begin(), points.end()), points.end());

    PointGrid kept(2.0 * distance);
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (i % 16384 == 0 && !stage.advance(i, points.size())) return stage.interrupted();
        if (kept.first_within(points[i], distance) == kept.points().size()) kept.add(points[i]);
    }
    stage.count("samples", static_cast<double>(kept.points().size()));
    return std::move(kept).take_points();
}

}  // namespace camdir::bake
