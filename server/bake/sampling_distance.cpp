#include "bake/sampling_distance.hpp"

#include <algorithm>
#include <cmath>

namespace camdir::bake {
namespace {

std::vector<Box3d> boxes_of_points(const std::vector<Vec3d>& points) {
    std::vector<Box3d> boxes;
    boxes.reserve(points.size());
    for (const Vec3d& p : points)
        boxes.emplace_back(p);
    return boxes;
}

}  // namespace

SamplingDistance::SamplingDistance(double d0, double coarsest, std::vector<Vec3d> medial_axis)
    : d0_(d0), coarsest_(coarsest), tree_(boxes_of_points(medial_axis)) {
    medial_axis_.reserve(medial_axis.size());
    for (const std::uint32_t index : tree_.order())
        medial_axis_.push_back(medial_axis[index]);
}

double SamplingDistance::at(const Vec3d& point) const {
    const double farthest = reach(coarsest_);
    double nearest2 = farthest * farthest;
    tree_.visit_by([&](const Box3d& box) { return box.squaredExteriorDistance(point); },
                   [&] { return nearest2; },
                   [&](std::uint32_t position) {
                       nearest2 = std::min(nearest2, (medial_axis_[position] - point).squaredNorm());
                   });
    return std::clamp(share * std::sqrt(nearest2), d0_, coarsest_);
}

// An obstacle point x, r away from a sample p of its surroundings and rho <= r from its nearest sample n:
// d_s(n) >= d_s(p) - share (r + rho) as d_s changes no faster than `share`, which exceeds rho when
// d_s(p) > (1 + 2 share) r. And d_s(n) >= d0 > rho when d0 > r.
double SamplingDistance::covering(double smallest) const {
    return std::max(d0_, smallest / (1.0 + 2.0 * share));
}

}  // namespace camdir::bake
