#include "bake/geometry/circumcentre.hpp"

#include <CGAL/Exact_rational.h>
#include <CGAL/Simple_cartesian.h>

#include <cmath>

namespace camdir::bake {
namespace {

Vec3d exact_circumcentre(const std::array<Vec3d, 4>& points) {
    using Kernel = CGAL::Simple_cartesian<CGAL::Exact_rational>;
    const auto exact = [](const Vec3d& p) { return Kernel::Point_3(p.x(), p.y(), p.z()); };
    const Kernel::Point_3 centre =
        CGAL::circumcenter(exact(points[0]), exact(points[1]), exact(points[2]), exact(points[3]));
    return {CGAL::to_double(centre.x()), CGAL::to_double(centre.y()), CGAL::to_double(centre.z())};
}

}  // namespace

Vec3d circumcentre(const std::array<Vec3d, 4>& points) {
    const Vec3d u = points[1] - points[0];
    const Vec3d v = points[2] - points[0];
    const Vec3d w = points[3] - points[0];
    const Vec3d vw = v.cross(w);
    const double volume6 = u.dot(vw);
    // Relative volume of the tetrahedron: rounding loses about 1e-16 over it.
    constexpr double trusted = 1e-6;
    const double size = std::sqrt(u.squaredNorm() * v.squaredNorm() * w.squaredNorm());
    if (std::abs(volume6) < trusted * size) return exact_circumcentre(points);
    const Vec3d sum = u.squaredNorm() * vw + v.squaredNorm() * w.cross(u) + w.squaredNorm() * u.cross(v);
    return points[0] + sum / (2.0 * volume6);
}

}  // namespace camdir::bake
