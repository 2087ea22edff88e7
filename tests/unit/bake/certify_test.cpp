#include "bake/certify.hpp"

#include <gtest/gtest.h>

#include <random>

#include "bake/clearance.hpp"
#include "bake/crossing.hpp"
#include "bake/geometry/certificate.hpp"
#include "support/bake_twins.hpp"
#include "support/solid_scenes.hpp"

namespace camdir::bake {
namespace {

// A sheet of large triangles through the room, bent around the pillar: clearances at its vertices promise
// far more than there is between them.
MedialMesh coarse_sheet(std::mt19937& random) {
    std::uniform_real_distribution<float> jitter(-18.0F, 18.0F);
    MedialMesh mesh;
    const int columns = 7;
    const int rows = 6;
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x)
            mesh.vertices.emplace_back(20.0F + 36.0F * static_cast<float>(x),
                                       20.0F + 30.0F * static_cast<float>(y), 64.0F + jitter(random));
    for (std::uint32_t y = 0; y + 1 < rows; ++y)
        for (std::uint32_t x = 0; x + 1 < columns; ++x) {
            const std::uint32_t i = y * columns + x;
            mesh.triangles.push_back({i, i + 1, i + columns});
            mesh.triangles.push_back({i + 1, i + columns + 1, i + columns});
        }
    return mesh;
}

TEST(FreeDistances, NoSlabReachesIntoAnObstacle) {
    const test::SolidScene room = test::pillar_room();
    const Obstacles obstacles(room.scene());
    for (unsigned seed = 0; seed < 20; ++seed) {
        std::mt19937 random(seed);
        MedialMesh mesh = coarse_sheet(random);
        Stage stage("certify", {}, {});
        const auto clearance = clearances(mesh, obstacles, stage).value();
        ASSERT_TRUE(remove_crossing(mesh, clearance, obstacles, stage));
        const auto free = free_distances(mesh, clearance, obstacles, 0.005, stage).value();
        std::uniform_real_distribution<double> unit(0.0, 1.0);
        for (const freespace::Triangle& t : mesh.triangles) {
            const Triangle3d corners = mesh.corners(t);
            for (int i = 0; i < 200; ++i) {
                const double u = unit(random);
                const double v = unit(random) * (1.0 - u);
                const Vec3d m = (1.0 - u - v) * corners[0] + u * corners[1] + v * corners[2];
                const double r = (1.0 - u - v) * free[t.a] + u * free[t.b] + v * free[t.c];
                ASSERT_LE(r, room.clearance(m) + 1e-9) << "seed " << seed;
            }
        }
        for (std::size_t i = 0; i < free.size(); ++i)
            ASSERT_LE(free[i], clearance[i]);
    }
}

TEST(FreeDistances, GiveNothingAwayWhereTheClearanceIsLinear) {
    const test::SolidScene room = test::box_room();
    const Obstacles obstacles(room.scene());
    MedialMesh mesh;  // half way between floor and ceiling, and rising towards the ceiling
    mesh.vertices = {Vec3f(80, 80, 64), Vec3f(120, 80, 64), Vec3f(80, 110, 64), Vec3f(110, 110, 90)};
    mesh.triangles = {{0, 1, 2}, {1, 2, 3}};
    Stage stage("certify", {}, {});
    const auto clearance = clearances(mesh, obstacles, stage).value();
    const auto free = free_distances(mesh, clearance, obstacles, 0.005, stage).value();
    for (std::size_t i = 0; i < free.size(); ++i)
        EXPECT_FLOAT_EQ(free[i], static_cast<float>(clearance[i]));
}

// Many points near large slabs: the search takes its 64 steps, as no violation is less than a tolerance of 0.
TEST(FreeDistances, ASlabIsFreeAlsoWhenTheStepsAreUsedUp) {
    std::mt19937 random(8);
    std::uniform_real_distribution<double> coordinate(-100.0, 100.0);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (int round = 0; round < 20; ++round) {
        scene::Scene scene;
        for (int i = 0; i < 400; ++i)
            scene.points.emplace_back(coordinate(random), coordinate(random), 5.0 + 40.0 * unit(random));
        const Obstacles obstacles(scene);
        MedialMesh mesh;
        for (int i = 0; i < 3; ++i)
            mesh.vertices.emplace_back(static_cast<float>(coordinate(random)),
                                       static_cast<float>(coordinate(random)), 0.0F);
        mesh.triangles = {{0, 1, 2}};
        Stage stage("certify", {}, {});
        const std::vector<double> promised(3, 60.0);  // far more than there is
        const auto free = free_distances(mesh, promised, obstacles, 0.0, stage).value();
        const Triangle3d corners = mesh.corners(mesh.triangles[0]);
        EXPECT_GE(signed_gap(Slab(corners, {free[0], free[1], free[2]}), obstacles, 0.0).value, -1e-9);
        for (int i = 0; i < 500; ++i) {
            const double u = unit(random);
            const double v = unit(random) * (1.0 - u);
            const Vec3d m = (1.0 - u - v) * corners[0] + u * corners[1] + v * corners[2];
            const double r = (1.0 - u - v) * free[0] + u * free[1] + v * free[2];
            ASSERT_LE(r, test::distance_to_nearest(m, scene.points) + 1e-9) << "round " << round;
        }
    }
}

}  // namespace
}  // namespace camdir::bake
