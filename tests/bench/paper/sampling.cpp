#include "bench/paper/sampling.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "bake/sample.hpp"

namespace camdir::paper {
namespace {

using bake::Triangle3d;

// All triangles of one way to include the midpoints of the long edges.
struct Split {
    std::array<Triangle3d, 4> triangles;
    std::size_t count = 0;

    void add(const Vec3d& a, const Vec3d& b, const Vec3d& c) { triangles[count++] = {a, b, c}; }
};

// Corners rotated so that the long edges come first, and how many there are.
struct Ordered {
    Triangle3d corners;
    int long_edges;
};

Ordered long_edges_first(const Triangle3d& t, double limit2) {
    std::array<bool, 3> is_long{};
    for (std::size_t i = 0; i < 3; ++i)
        is_long[i] = (t[(i + 1) % 3] - t[i]).squaredNorm() >= limit2;
    const auto count = static_cast<int>(std::count(is_long.begin(), is_long.end(), true));
    std::size_t first = 0;
    while (count > 0 && count < 3 && !(is_long[first] && !is_long[(first + 2) % 3]))
        ++first;
    return {{t[first], t[(first + 1) % 3], t[(first + 2) % 3]}, count};
}

Split split(const Ordered& ordered, std::vector<Vec3d>& samples) {
    const auto& [a, b, c] = ordered.corners;
    const Vec3d ab = 0.5 * (a + b);
    samples.push_back(ab);
    Split parts;
    if (ordered.long_edges == 1) {
        parts.add(a, ab, c);
        parts.add(ab, b, c);
        return parts;
    }
    const Vec3d bc = 0.5 * (b + c);
    samples.push_back(bc);
    parts.add(ab, b, bc);
    if (ordered.long_edges == 2) {
        if ((bc - a).squaredNorm() <= (c - ab).squaredNorm()) {
            parts.add(a, ab, bc);
            parts.add(a, bc, c);
        } else {
            parts.add(a, ab, c);
            parts.add(ab, bc, c);
        }
        return parts;
    }
    const Vec3d ca = 0.5 * (c + a);
    samples.push_back(ca);
    parts.add(a, ab, ca);
    parts.add(ca, bc, c);
    parts.add(ab, bc, ca);
    return parts;
}

}  // namespace

bool split_long_edges(const Triangle3d& triangle, double d0, std::vector<Vec3d>& samples) {
    const Ordered ordered = long_edges_first(triangle, 4.0 * d0 * d0);
    if (ordered.long_edges == 0) return true;
    if (samples.size() > bake::max_samples) return false;
    const Split parts = split(ordered, samples);
    return std::all_of(parts.triangles.begin(),
                       parts.triangles.begin() + static_cast<std::ptrdiff_t>(parts.count),
                       [&](const Triangle3d& part) { return split_long_edges(part, d0, samples); });
}

Result<std::vector<Vec3d>> sample(const scene::Scene& scene, double d0) {
    if (scene.triangles.empty())
        return fail(scene.source + ": has no triangles, which the paper's rule samples");
    std::vector<Vec3d> samples;
    for (const auto& [a, b, c] : scene.triangles) {
        const Triangle3d triangle{scene.vertices[a], scene.vertices[b], scene.vertices[c]};
        samples.insert(samples.end(), triangle.begin(), triangle.end());
        if (!split_long_edges(triangle, d0, samples))
            return fail(scene.source + ": a sampling distance of " + std::to_string(d0) +
                        " map units needs too many samples; choose a larger d0");
    }
    const auto before = [](const Vec3d& p, const Vec3d& q) {
        return std::lexicographical_compare(p.begin(), p.end(), q.begin(), q.end());
    };
    std::sort(samples.begin(), samples.end(), before);
    samples.erase(std::unique(samples.begin(), samples.end()), samples.end());
    return samples;
}

}  // namespace camdir::paper
