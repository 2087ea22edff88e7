#include "bake/geometry/triangle.hpp"

#include <algorithm>

namespace camdir::bake {

int longest_edge(const Triangle3d& t) {
    int longest = 0;
    double length2 = -1.0;
    for (int i = 0; i < 3; ++i) {
        const double candidate = (t[(i + 1) % 3] - t[i]).squaredNorm();
        if (candidate <= length2) continue;
        longest = i;
        length2 = candidate;
    }
    return longest;
}

double longest_edge_length2(const Triangle3d& t) {
    const int from = longest_edge(t);
    return (t[(from + 1) % 3] - t[from]).squaredNorm();
}

std::array<Triangle3d, 2> halves(const Triangle3d& t) {
    const int from = longest_edge(t);
    const Vec3d& a = t[from];
    const Vec3d& b = t[(from + 1) % 3];
    const Vec3d& c = t[(from + 2) % 3];
    // The sum commutes exactly, so both triangles of a shared edge get the same point.
    const Vec3d middle = 0.5 * (a + b);
    return {{{a, middle, c}, {middle, b, c}}};
}

Vec3d closest_point(const Vec3d& a, const Vec3d& b, const Vec3d& p) {
    const Vec3d along = b - a;
    const double length2 = along.squaredNorm();
    if (length2 == 0.0) return a;
    return a + std::clamp(along.dot(p - a) / length2, 0.0, 1.0) * along;
}

Vec3d closest_point(const Triangle3d& triangle, const Vec3d& p) {
    const auto& [a, b, c] = triangle;
    const Vec3d ab = b - a;
    const Vec3d ac = c - a;
    const Vec3d normal = ab.cross(ac);
    const double area2 = normal.squaredNorm();
    // Barycentric coordinates of the projection, times area2.
    const Vec3d ap = p - a;
    const double weight_b = ap.cross(ac).dot(normal);
    const double weight_c = ab.cross(ap).dot(normal);
    const double weight_a = area2 - weight_b - weight_c;
    if (area2 > 0.0 && weight_a >= 0.0 && weight_b >= 0.0 && weight_c >= 0.0)
        return p - normal * (ap.dot(normal) / area2);

    // Outside the prism above the triangle: on an edge whose side the projection lies beyond; beyond two
    // sides it is on either.
    Vec3d best = a;
    double best_distance2 = (p - a).squaredNorm();
    const auto consider = [&](const Vec3d& from, const Vec3d& to) {
        const Vec3d q = closest_point(from, to, p);
        const double distance2 = (p - q).squaredNorm();
        if (distance2 < best_distance2) {
            best = q;
            best_distance2 = distance2;
        }
    };
    const bool flat = !(area2 > 0.0);
    if (flat || weight_c < 0.0) consider(a, b);
    if (flat || weight_a < 0.0) consider(b, c);
    if (flat || weight_b < 0.0) consider(c, a);
    return best;
}

}  // namespace camdir::bake
