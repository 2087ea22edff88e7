#include "bake/sample.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace camdir::bake {
namespace {

struct Edge {
    int from;
    double length2;
};

// The longest edge, from corner `from` to the next one.
Edge longest_edge(const Triangle3d& t) {
    Edge longest{0, -1.0};
    for (int i = 0; i < 3; ++i) {
        const double length2 = (t[(i + 1) % 3] - t[i]).squaredNorm();
        if (length2 > longest.length2) longest = {i, length2};
    }
    return longest;
}

// Appends the midpoints that bisecting the longest edges adds until the triangles are fine enough. False when
// there are too many or when the stage must end.
bool refine(const Triangle3d& t, double distance, std::vector<Vec3d>& samples, Stage& stage) {
    const Edge longest = longest_edge(t);
    const double limit2 = 4.0 * distance * distance;
    if (longest.length2 < limit2 && covering_radius(t) < distance) return true;
    if (samples.size() > max_samples) return false;
    const Vec3d& a = t[longest.from];
    const Vec3d& b = t[(longest.from + 1) % 3];
    const Vec3d& c = t[(longest.from + 2) % 3];
    // The sum commutes exactly, so both triangles of a shared edge get the same point.
    const Vec3d middle = 0.5 * (a + b);
    samples.push_back(middle);
    if (samples.size() % 65536 == 0 && !stage.advance(0, 0)) return false;
    return refine({a, middle, c}, distance, samples, stage) &&
           refine({middle, b, c}, distance, samples, stage);
}

double area(const Triangle3d& t) {
    return 0.5 * (t[1] - t[0]).cross(t[2] - t[0]).norm();
}

tl::unexpected<Error> too_many(const scene::Scene& scene, double distance, double at_least) {
    const auto millions = static_cast<std::uint64_t>(std::min(at_least / 1e6, 1e12));
    return fail(scene.source + ": a sampling distance of " + std::to_string(distance) +
                " map units needs more than " + std::to_string(millions) +
                " million samples, and the limit is " + std::to_string(max_samples / 1'000'000U) +
                " million; choose a larger d0");
}

}  // namespace

double covering_radius(const Triangle3d& t) {
    const Edge longest = longest_edge(t);
    const Vec3d& a = t[longest.from];
    const Vec3d& b = t[(longest.from + 1) % 3];
    const Vec3d& apex = t[(longest.from + 2) % 3];
    if (longest.length2 == 0.0) return 0.0;
    const Vec3d along = (b - a) / std::sqrt(longest.length2);
    const Vec3d to_a = a - apex;
    const Vec3d to_b = b - apex;
    if (to_a.dot(to_b) >= 0.0) {
        // Not obtuse: the circumcentre lies inside. Without area the apex lies on an end.
        const double twice_area = to_a.cross(to_b).norm();
        if (twice_area == 0.0) return 0.5 * std::sqrt(longest.length2);
        return to_a.norm() * to_b.norm() * std::sqrt(longest.length2) / (2.0 * twice_area);
    }
    // Obtuse: on the longest edge, where the cells of its ends meet the apex's cell.
    const double from_a = to_a.squaredNorm() / (-2.0 * to_a.dot(along));
    const double from_b = to_b.squaredNorm() / (2.0 * to_b.dot(along));
    return std::max(from_a, from_b);
}

Result<std::vector<Vec3d>> sample(const scene::Scene& scene, double distance, Stage& stage) {
    std::vector<Triangle3d> triangles;
    triangles.reserve(scene.triangles.size());
    double discs = 0.0;  // a sample covers at most a disc
    for (const auto& [a, b, c] : scene.triangles) {
        triangles.push_back({scene.vertices[a], scene.vertices[b], scene.vertices[c]});
        discs += area(triangles.back()) / (M_PI * distance * distance);
    }
    if (discs > static_cast<double>(max_samples)) return too_many(scene, distance, discs);

    std::vector<Vec3d> samples;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        if (i % 256 == 0 && !stage.advance(i, triangles.size())) return stage.interrupted();
        const Triangle3d& triangle = triangles[i];
        samples.insert(samples.end(), triangle.begin(), triangle.end());
        const bool refined = refine(triangle, distance, samples, stage);
        if (samples.size() > max_samples)
            return too_many(scene, distance, static_cast<double>(samples.size()));
        if (!refined) return stage.interrupted();
    }
    stage.count("triangles", static_cast<double>(triangles.size()));
    stage.count("points", static_cast<double>(samples.size()));
    return samples;
}

}  // namespace camdir::bake
