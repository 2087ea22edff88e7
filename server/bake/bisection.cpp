#include "bake/bisection.hpp"

#include <algorithm>
#include <cmath>

namespace camdir::bake {

double covering_radius(const Triangle3d& t) {
    const int from = longest_edge(t);
    const Vec3d& a = t[from];
    const Vec3d& b = t[(from + 1) % 3];
    const Vec3d& apex = t[(from + 2) % 3];
    const double length = (b - a).norm();
    if (length == 0.0) return 0.0;
    const Vec3d along = (b - a) / length;
    const Vec3d to_a = a - apex;
    const Vec3d to_b = b - apex;
    if (to_a.dot(to_b) >= 0.0) {
        // Not obtuse: the circumcentre lies inside. Without area the apex lies on an end.
        const double twice_area = to_a.cross(to_b).norm();
        if (twice_area == 0.0) return 0.5 * length;
        return to_a.norm() * to_b.norm() * length / (2.0 * twice_area);
    }
    // Obtuse: on the longest edge, where the cells of its ends meet the apex's cell.
    const double from_a = to_a.squaredNorm() / (-2.0 * to_a.dot(along));
    const double from_b = to_b.squaredNorm() / (2.0 * to_b.dot(along));
    return std::max(from_a, from_b);
}

Piece Bisection::piece(const Triangle3d& t) const {
    return {t, {distance_.at(t[0]), distance_.at(t[1]), distance_.at(t[2])}};
}

bool Bisection::is_buried(const Triangle3d& t) const {
    return solids_.is_buried(t, 0.001 * distance_.finest());
}

bool Bisection::is_fine(const Piece& piece) const {
    const auto& [a, b, c] = piece.distances;
    const double max_radius = distance_.covering(std::min({a, b, c})) - slack_;
    return longest_edge_length2(piece.corners) < 4.0 * max_radius * max_radius &&
           covering_radius(piece.corners) < max_radius;
}

std::array<Piece, 2> Bisection::halves(const Piece& piece) const {
    const int from = longest_edge(piece.corners);
    const auto& at = piece.distances;
    const auto [first, second] = bake::halves(piece.corners);
    const double at_middle = distance_.at(first[1]);
    const double at_apex = at[(from + 2) % 3];
    return {{{first, {at[from], at_middle, at_apex}}, {second, {at_middle, at[(from + 1) % 3], at_apex}}}};
}

double Bisection::fine_above_d0(const Piece& piece) const {
    return std::max(0.5 * std::sqrt(longest_edge_length2(piece.corners)), covering_radius(piece.corners)) +
           slack_;
}

}  // namespace camdir::bake
