#include "scene/cloud/read_scene.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include "scene/cloud/las.hpp"
#include "scene/cloud/neighbours.hpp"
#include "scene/cloud/pcd.hpp"
#include "scene/coordinate_transform.hpp"
#include "scene/records/ply.hpp"
#include "scene/records/records.hpp"

namespace camdir::scene {
namespace {

constexpr std::size_t min_points = 4;
constexpr std::size_t neighbour_count = 8;
// Scanners see far walls thinly: a point is an outlier when its neighbours are this many times further away
// than those of the 95th percentile.
constexpr double spacing_percentile = 0.95;
constexpr double outlier_factor = 4.0;

Result<std::vector<Vec3d>> read_points(std::span<const std::byte> bytes, CloudFormat format) {
    Lines lines(text_of(bytes));
    switch (format) {
        case CloudFormat::pcd:
            return read_pcd(bytes);
        case CloudFormat::ply:
            return read_ply_points(bytes);
        case CloudFormat::las:
            return read_las(bytes);
        case CloudFormat::xyz:
            break;
    }
    return read_lines(lines, {0, 1, 2}, std::nullopt);
}

const char* name_of(CloudFormat format) {
    constexpr std::array<const char*, 4> names = {"PCD", "PLY", "XYZ", "LAS"};
    return names[static_cast<std::size_t>(format)];
}

void skip(Scene& scene, std::string reason, std::size_t count) {
    if (count > 0) scene.skipped.push_back({std::move(reason), "", count});
}

// In PCD a NaN means that the scanner saw nothing there.
void drop_missing(std::vector<Vec3d>& points, Scene& scene) {
    const auto missing = [](const Vec3d& p) { return p.array().isNaN().any(); };
    const auto kept = std::remove_if(points.begin(), points.end(), missing);
    skip(scene, "points without a position", static_cast<std::size_t>(points.end() - kept));
    points.erase(kept, points.end());
}

// Sorts too, which makes the scene independent of the order in the file.
void drop_repeated(std::vector<Vec3d>& points, Scene& scene) {
    std::sort(points.begin(), points.end(), [](const Vec3d& a, const Vec3d& b) {
        return std::tuple(a.x(), a.y(), a.z()) < std::tuple(b.x(), b.y(), b.z());
    });
    const auto kept = std::unique(points.begin(), points.end());
    skip(scene, "repeated points", static_cast<std::size_t>(points.end() - kept));
    points.erase(kept, points.end());
}

double percentile(std::vector<double> values, double share) {
    const auto place =
        values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), place, values.end());
    return *place;
}

// Sets the scene's spacing.
void drop_outliers(std::vector<Vec3d>& points, Scene& scene) {
    const std::size_t count = std::min(neighbour_count, points.size() - 1);
    const std::vector<double> distances = neighbour_distances(points, count);
    scene.point_spacing = percentile(distances, spacing_percentile);
    const double limit = outlier_factor * scene.point_spacing;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (distances[i] <= limit) points[kept++] = points[i];
    }
    skip(scene, "outliers", points.size() - kept);
    points.resize(kept);
}

}  // namespace

Result<Scene> read_cloud_scene(std::span<const std::byte> bytes, CloudFormat format,
                               const ReadOptions& options) {
    auto points = read_points(bytes, format);
    if (!points) return tl::unexpected(points.error());
    const CoordinateTransform coordinates(options, UpAxis::z);
    Scene scene;
    scene.kind = std::string("point cloud (") + name_of(format) + ")";
    scene.metres_per_unit = coordinates.metres_per_unit();
    if (format == CloudFormat::pcd) drop_missing(*points, scene);
    for (std::size_t i = 0; i < points->size(); ++i) {
        const auto placed = coordinates.place((*points)[i], "point", i);
        if (!placed) return tl::unexpected(placed.error());
        (*points)[i] = *placed;
    }
    drop_repeated(*points, scene);
    if (points->size() < min_points)
        return fail(std::to_string(points->size()) + " different points; expected at least " +
                    std::to_string(min_points));
    drop_outliers(*points, scene);
    if (!(scene.point_spacing > 0.0))
        return fail("the distances between its points round to 0; expected points that lie apart");
    scene.points = std::move(*points);
    for (const Vec3d& point : scene.points)
        scene.bounds.extend(point);
    return scene;
}

}  // namespace camdir::scene
