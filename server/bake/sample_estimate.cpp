#include "bake/sample_estimate.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "bake/geometry/triangle.hpp"

namespace camdir::bake {
namespace {

// Bisection leaves a sample on about so many squares of the distance that covers a triangle.
constexpr double squares_of_sample = 0.85;
constexpr double edges_of_sample = 0.5;  // a sliver's two long edges, each shared with another triangle
constexpr std::uint64_t probe_count = 16'384;

double longest_edge_of(const Triangle3d& t) {
    const int from = longest_edge(t);
    return (t[(from + 1) % 3] - t[from]).norm();
}

// Point number `i` of a sequence that fills a triangle evenly (a Kronecker sequence, folded).
Vec3d spread_point(const Triangle3d& t, std::uint64_t i) {
    double u = std::fmod(0.7548776662466927 * static_cast<double>(i), 1.0);
    double v = std::fmod(0.5698402909980532 * static_cast<double>(i), 1.0);
    if (u + v > 1.0) {
        u = 1.0 - u;
        v = 1.0 - v;
    }
    return t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0]);
}

// A copy of the triangle around one of its points, as small as sampling makes its pieces.
Triangle3d piece_at(const Triangle3d& t, const Vec3d& p, double length) {
    const double size = std::min(1.0, length / longest_edge_of(t));
    return {p + size * (t[0] - p), p + size * (t[1] - p), p + size * (t[2] - p)};
}

}  // namespace

SampleEstimate::SampleEstimate(const scene::Scene& scene, const Solids& solids,
                               const SamplingDistance& distance, double slack)
    : corners_(static_cast<double>(scene.vertices.size())), slack_(slack) {
    // Large triangles get samples by their area, slivers by their length.
    const auto weight = [&](const Triangle3d& t) { return area(t) + distance.finest() * longest_edge_of(t); };
    std::vector<double> weight_up_to;
    double sum = 0.0;
    for (std::size_t i = 0; i < scene.triangles.size(); ++i)
        weight_up_to.push_back(sum += weight(scene::corners(scene, i)));
    const double step = sum / static_cast<double>(probe_count);
    for (std::uint64_t i = 0; i < probe_count; ++i) {
        const double position = (static_cast<double>(i) + 0.5) * step;
        const auto found = std::upper_bound(weight_up_to.begin(), weight_up_to.end(), position);
        if (found == weight_up_to.end()) break;
        const Triangle3d t = scene::corners(scene, static_cast<std::size_t>(found - weight_up_to.begin()));
        const Vec3d p = spread_point(t, i);
        if (solids.is_buried(piece_at(t, p, distance.at(p)), 0.001 * distance.finest())) continue;
        probes_.push_back({distance.at(p), area(t), longest_edge_of(t), step / weight(t)});
    }
}

double SampleEstimate::samples(double d0) const {
    if (known_samples_ > 0.0) return known_samples_ * std::min(1.0, std::pow(known_d0_ / d0, 2.0));
    const SamplingDistance uniform(d0);
    double midpoints = 0.0;
    for (const Probe& probe : probes_) {
        const double limit = uniform.covering(std::max(probe.sampling_distance, d0)) - slack_;
        const double on_area = probe.area / (squares_of_sample * limit * limit);
        const double on_edges = edges_of_sample * probe.length / limit;
        // The corners, about half a one to each triangle, are there without being asked for.
        midpoints += probe.triangle_share * std::max(0.0, on_area + on_edges - 0.5);
    }
    return corners_ + midpoints;
}

}  // namespace camdir::bake
