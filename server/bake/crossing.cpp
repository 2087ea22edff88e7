#include "bake/crossing.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/intersections.h>

#include <algorithm>

namespace camdir::bake {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

Kernel::Triangle_3 exact(const Triangle3d& t) {
    const auto point = [](const Vec3d& p) { return Kernel::Point_3(p.x(), p.y(), p.z()); };
    return {point(t[0]), point(t[1]), point(t[2])};
}

bool crosses(const Triangle3d& triangle, const Obstacles& obstacles) {
    const Box3d box = box_of(triangle);
    const Kernel::Triangle_3 candidate = exact(triangle);
    bool found = false;
    obstacles.tree().visit_where([&](const Box3d& node) { return !found && node.intersects(box); },
                                 [&](std::uint32_t position) {
                                     const Triangle3d& obstacle = obstacles.triangles()[position];
                                     found = found || (box_of(obstacle).intersects(box) &&
                                                       CGAL::do_intersect(candidate, exact(obstacle)));
                                 });
    return found;
}

// The ball of free space around one corner holds the whole triangle.
bool in_free_ball(const Triangle3d& corners, const std::array<double, 3>& clearance) {
    constexpr double rounding = 1.0 - 1e-9;
    for (int i = 0; i < 3; ++i) {
        const double reach2 = std::max((corners[(i + 1) % 3] - corners[i]).squaredNorm(),
                                       (corners[(i + 2) % 3] - corners[i]).squaredNorm());
        if (reach2 < clearance[i] * clearance[i] * rounding) return true;
    }
    return false;
}

}  // namespace

Result<void> remove_crossing(MedialMesh& mesh, const std::vector<double>& clearance,
                             const Obstacles& obstacles, Stage& stage) {
    const std::size_t before = mesh.triangles.size();
    std::vector<char> keep(before);
    const bool done = stage.for_each(before, [&](std::uint64_t i) {
        const freespace::Triangle& t = mesh.triangles[i];
        const Triangle3d corners = mesh.corners(t);
        keep[i] = in_free_ball(corners, {clearance[t.a], clearance[t.b], clearance[t.c]}) ||
                  !crosses(corners, obstacles);
    });
    if (!done) return stage.interrupted();
    keep_triangles(mesh, keep);
    stage.count("crossing triangles", static_cast<double>(before - mesh.triangles.size()));
    return {};
}

}  // namespace camdir::bake
