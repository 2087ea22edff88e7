#include "support/scene_measures.hpp"

#include <algorithm>

#include "support/oracle_twins.hpp"

namespace camdir::test {
namespace {

std::string key_of(const scene::Skipped& entry) {
    return entry.what.empty() ? entry.reason : entry.reason + ": " + entry.what;
}

}  // namespace

double area_of(const scene::Scene& scene) {
    double area = 0.0;
    for (const auto& [a, b, c] : scene.triangles) {
        area +=
            (scene.vertices[b] - scene.vertices[a]).cross(scene.vertices[c] - scene.vertices[a]).norm() / 2.0;
    }
    return area;
}

double surface_of(const Box3d& box) {
    const Vec3d s = box.sizes();
    return 2.0 * (s.x() * s.y() + s.y() * s.z() + s.z() * s.x());
}

bool has_surface_at(const scene::Scene& scene, const Vec3d& point) {
    return std::any_of(scene.triangles.begin(), scene.triangles.end(), [&](const auto& t) {
        return distance_to_triangle(point, scene.vertices[t[0]], scene.vertices[t[1]], scene.vertices[t[2]]) <
               0.01;
    });
}

std::map<std::string, std::uint64_t> skipped_counts(const scene::Scene& scene) {
    std::map<std::string, std::uint64_t> counts;
    for (const scene::Skipped& entry : scene.skipped) {
        counts[key_of(entry)] = entry.count;
    }
    return counts;
}

std::map<std::string, double> skipped_areas(const scene::Scene& scene) {
    std::map<std::string, double> areas;
    for (const scene::Skipped& entry : scene.skipped) {
        areas[key_of(entry)] = entry.area;
    }
    return areas;
}

}  // namespace camdir::test
