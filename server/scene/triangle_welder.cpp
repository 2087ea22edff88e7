#include "scene/triangle_welder.hpp"

#include <algorithm>

namespace camdir::scene {

bool TriangleWelder::add(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
    const Corners corners = {vertex_at(a), vertex_at(b), vertex_at(c)};
    if (is_flat(corners)) return false;
    Corners ascending = corners;
    std::sort(ascending.begin(), ascending.end());
    if (!known_triangles_.insert(ascending).second) return false;
    triangles_.push_back(corners);
    return true;
}

std::uint32_t TriangleWelder::vertex_at(const Vec3d& point) {
    const std::uint32_t first = vertices_.first_within(point, tolerance_);
    return first == vertices_.points().size() ? vertices_.add(point) : first;
}

bool TriangleWelder::is_flat(const Corners& corners) const {
    const Vec3d& a = vertices_.points()[corners[0]];
    const Vec3d& b = vertices_.points()[corners[1]];
    const Vec3d& c = vertices_.points()[corners[2]];
    const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
    const double twice_area = (b - a).cross(c - a).norm();
    return twice_area <= longest * tolerance_ / 100.0;
}

}  // namespace camdir::scene
