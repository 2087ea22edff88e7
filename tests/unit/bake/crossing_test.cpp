#include "bake/crossing.hpp"

#include <gtest/gtest.h>

#include <random>

#include "bake/clearance.hpp"
#include "support/bake_twins.hpp"
#include "support/solid_scenes.hpp"

namespace camdir::bake {
namespace {

// Loose triangles around a point.
MedialMesh random_mesh(std::mt19937& random, const Vec3d& centre, double size, int count) {
    std::uniform_real_distribution<double> coordinate(-size, size);
    MedialMesh mesh;
    for (int i = 0; i < count; ++i) {
        const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
        for (int k = 0; k < 3; ++k) {
            const Vec3d p = centre + Vec3d(coordinate(random), coordinate(random), coordinate(random));
            mesh.vertices.push_back(p.cast<float>());
        }
        mesh.triangles.push_back({first, first + 1, first + 2});
    }
    return mesh;
}

TEST(RemoveCrossing, KeepsExactlyWhatStaysClearOfTheObstacles) {
    std::mt19937 random(16);
    const test::SolidScene room = test::pillar_room();
    const Obstacles obstacles(room.scene());
    const MedialMesh before = random_mesh(random, {166, 76, 64}, 60.0, 400);
    MedialMesh after = before;
    Stage stage("crossing", {}, {});
    const auto clearance = clearances(before, obstacles, stage).value();
    ASSERT_TRUE(remove_crossing(after, clearance, obstacles, stage));

    constexpr int steps = 80;
    std::size_t kept = 0;
    int decided = 0;
    for (const freespace::Triangle& t : before.triangles) {
        const Triangle3d corners = before.corners(t);
        double nearest = std::numeric_limits<double>::infinity();
        double farthest = 0.0;
        for (int i = 0; i <= steps; ++i)
            for (int j = 0; i + j <= steps; ++j) {
                const double u = static_cast<double>(i) / steps;
                const double v = static_cast<double>(j) / steps;
                const double clearance_there = room.clearance(test::point_of(corners, {1.0 - u - v, u, v}));
                nearest = std::min(nearest, clearance_there);
                farthest = std::max(farthest, clearance_there);
            }
        const bool is_kept = kept < after.triangles.size() && after.triangles[kept].a == t.a;
        kept += is_kept;
        // In between, the triangle touches a solid or lies inside one.
        const bool leaves_a_solid = nearest == 0.0 && farthest > 0.0;
        const bool in_the_open = nearest > 120.0 * 2.0 / steps;
        if (leaves_a_solid || in_the_open) {
            ++decided;
            EXPECT_EQ(is_kept, in_the_open) << "triangle " << t.a;
        }
    }
    EXPECT_GT(decided, 300);
    EXPECT_EQ(kept, after.triangles.size()) << "the order stays";
    EXPECT_GT(kept, 10U);
    EXPECT_LT(kept, before.triangles.size() - 10U);
}

TEST(RemoveCrossing, TouchingIsCrossing) {
    test::SolidScene room = test::box_room();
    const Obstacles obstacles(room.scene());
    MedialMesh mesh;
    mesh.vertices = {Vec3f(50, 50, 0), Vec3f(60, 50, 20), Vec3f(50, 60, 20)};
    mesh.triangles = {{0, 1, 2}};
    Stage stage("crossing", {}, {});
    const auto clearance = clearances(mesh, obstacles, stage).value();
    EXPECT_EQ(clearance[0], 0.0);
    ASSERT_TRUE(remove_crossing(mesh, clearance, obstacles, stage));
    EXPECT_TRUE(mesh.triangles.empty());
}

}  // namespace
}  // namespace camdir::bake
