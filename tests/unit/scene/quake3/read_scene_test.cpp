// Which parts of a Quake 3 map become obstacles.
#include "scene/quake3/read_scene.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/oracle_twins.hpp"
#include "support/q3_maps.hpp"
#include "support/scene_measures.hpp"

namespace camdir::scene {
namespace {

const Box3d hall(Vec3d(-256.0, -192.0, 0.0), Vec3d(256.0, 192.0, 256.0));
const Box3d crate(Vec3d(0.0, 0.0, 0.0), Vec3d(64.0, 64.0, 64.0));

using test::area_of;
using test::has_surface_at;
using test::skipped_counts;
using test::surface_of;

TEST(Q3Scene, RoomIsItsInnerSurface) {
    const Scene scene = test::scene_of(test::room_map(hall));
    EXPECT_NEAR(area_of(scene), surface_of(hall), 1e-6) << "faces towards the void are dropped";
    EXPECT_EQ(scene.vertices.size(), 8U) << "welded";
    EXPECT_EQ(scene.triangles.size(), 12U);
    EXPECT_EQ(scene.brushes.size(), 6U) << "volumes are all kept";
    EXPECT_DOUBLE_EQ(scene.metres_per_unit, 0.0254);
    for (const Vec3d& vertex : scene.vertices) {
        EXPECT_TRUE(scene.bounds.contains(vertex));
    }
    EXPECT_GT(skipped_counts(scene)["face that nobody can see"], 0U);
}

TEST(Q3Scene, SkyIsAnObstacleAndClipWaterAndGhostBrushesAreNot) {
    for (const test::Shader shader : {test::stone, test::sky, test::clip, test::water, test::ghost}) {
        q3::Bsp bsp = test::room_map(hall);
        test::add_box(bsp, crate, shader);
        const Scene scene = test::scene_of(bsp);
        const bool is_obstacle = shader == test::stone || shader == test::sky;
        EXPECT_EQ(has_surface_at(scene, {32.0, 32.0, 64.0}), is_obstacle) << shader;
        EXPECT_EQ(test::depth_in_solid(scene, crate.center()) >= 0.0, is_obstacle) << shader;
        EXPECT_EQ(scene.brushes.size(), is_obstacle ? 7U : 6U);
    }
}

TEST(Q3Scene, SkippedIsCounted) {
    q3::Bsp bsp = test::room_map(hall);
    test::add_box(bsp, crate, test::clip);
    test::add_box(bsp, crate, test::water);
    test::add_patch(bsp, 3, 3, std::vector<Vec3d>(9, crate.center()), test::ghost);
    test::add_soup(bsp, {{0, 0, 9}, {9, 0, 9}, {0, 9, 9}}, test::ghost);
    test::add_entity_model(bsp, "func_door", Vec3d::Zero());
    test::add_box(bsp, crate, test::stone);
    const Scene scene = test::scene_of(bsp);
    const auto counts = skipped_counts(scene);
    EXPECT_THAT(counts, testing::IsSupersetOf({testing::Pair("clip: test/clip", 6),
                                               testing::Pair("liquid: test/water", 6),
                                               testing::Pair("kept as a mover: func_door", 6)}));
    EXPECT_GE(counts.at("not solid: test/ghost"), 2U) << "the soup and the patch";
    const auto areas = test::skipped_areas(scene);
    EXPECT_NEAR(areas.at("liquid: test/water"), surface_of(crate), 1e-6);
    EXPECT_NEAR(areas.at("kept as a mover: func_door"), surface_of(crate), 1e-6);
    EXPECT_NEAR(areas.at("not solid: test/ghost"), 40.5, 1e-6);
    EXPECT_NEAR(area_of(scene), surface_of(hall), 1e-6);
}

TEST(Q3Scene, StaticModelsAreTakenWhereTheirEntityStands) {
    q3::Bsp bsp = test::room_map(hall);
    const Vec3d origin(64.0, -32.0, 100.0);
    test::add_entity_model(bsp, "func_static", origin);
    test::add_box(bsp, crate, test::stone);
    const Scene scene = test::scene_of(bsp);
    EXPECT_TRUE(has_surface_at(scene, Vec3d(32.0, 32.0, 64.0) + origin));
    EXPECT_FALSE(has_surface_at(scene, {32.0, 32.0, 64.0}));
    EXPECT_GE(test::depth_in_solid(scene, crate.center() + origin), 0.0);
    EXPECT_NEAR(area_of(scene), surface_of(hall) + surface_of(crate), 1e-6);
}

TEST(Q3Scene, OtherModelsAreSkippedByClass) {
    q3::Bsp bsp = test::room_map(hall);
    for (const char* name : {"func_button", "func_bobbing", "func_of_a_mod", ""}) {
        test::add_entity_model(bsp, name, Vec3d::Zero());
        test::add_box(bsp, crate, test::stone);
    }
    const Scene scene = test::scene_of(bsp);
    EXPECT_NEAR(area_of(scene), surface_of(hall), 1e-6);
    EXPECT_THAT(skipped_counts(scene),
                testing::IsSupersetOf({testing::Pair("kept as a mover: func_button", 6),
                                       testing::Pair("kept as a mover: func_bobbing", 6),
                                       testing::Pair("unknown class: func_of_a_mod", 6),
                                       testing::Pair("unknown class: without a name", 6)}));
}

TEST(Q3Scene, MoversAreTheirSolidBrushesInTheirOwnFrame) {
    q3::Bsp bsp = test::room_map(hall);
    test::add_entity_model(bsp, "func_static", Vec3d::Zero());
    test::add_box(bsp, crate, test::stone);
    const Vec3d origin(64.0, -32.0, 100.0);
    test::add_entity_model(bsp, "func_door", origin);
    test::add_box(bsp, crate, test::stone);
    test::add_box(bsp, crate, test::clip);
    // A wedge, one side of which no other leaves a part of.
    const double s = std::sqrt(0.5);
    test::add_brush(bsp,
                    {{{0, 0, 1}, 8},
                     {{0, 0, -1}, 0},
                     {{0, -1, 0}, 0},
                     {{-1, 0, 0}, 0},
                     {{s, s, 0}, s * 8},
                     {{1, 0, 0}, 90}},
                    test::stone);
    test::add_entity_model(bsp, "func_plat", Vec3d::Zero());
    test::add_box(bsp, crate, test::water);
    const Scene scene = test::scene_of(bsp);
    ASSERT_EQ(scene.movers.size(), 1U);
    const Mover& door = scene.movers[0];
    EXPECT_EQ(door.name, "*2");
    EXPECT_EQ(door.kind, "func_door");
    EXPECT_EQ(door.rest, origin);
    ASSERT_EQ(door.parts.size(), 2U) << "clip is not solid";
    EXPECT_EQ(door.parts[0].planes.size(), 6U);
    EXPECT_TRUE(door.parts[0].bounds.isApprox(crate));
    EXPECT_EQ(door.parts[1].planes.size(), 5U);
    EXPECT_TRUE(door.parts[1].bounds.isApprox(Box3d(Vec3d::Zero(), Vec3d(8.0, 8.0, 8.0)), 1e-5));
    EXPECT_FALSE(has_surface_at(scene, Vec3d(32.0, 32.0, 64.0) + origin));
}

TEST(Q3Scene, MoversWithoutASolidPartAreSkippedByClass) {
    q3::Bsp bsp = test::room_map(hall);
    test::add_entity_model(bsp, "func_door", Vec3d::Zero());
    test::add_soup(bsp, {{0, 0, 9}, {9, 0, 9}, {0, 9, 9}}, test::stone);
    const Scene scene = test::scene_of(bsp);
    EXPECT_TRUE(scene.movers.empty());
    EXPECT_EQ(skipped_counts(scene)["mover without a solid part: func_door"], 1U);
}

TEST(Q3Scene, AModelOfSeveralEntitiesIsOneMover) {
    q3::Bsp bsp = test::room_map(hall);
    bsp.entities += R"({"classname" "trigger_once" "model" "*1"} {"classname" "func_plat" "model" "*1"})";
    test::add_entity_model(bsp, "func_door", Vec3d::Ones());
    test::add_box(bsp, crate, test::stone);
    const Scene scene = test::scene_of(bsp);
    ASSERT_EQ(scene.movers.size(), 1U);
    EXPECT_EQ(scene.movers[0].kind, "func_plat");
}

TEST(Q3Scene, PatchesAndSoupsAreObstacles) {
    q3::Bsp bsp = test::room_map(hall);
    test::add_soup(bsp, {{0, 0, 9}, {90, 0, 9}, {0, 90, 9}}, test::stone);
    std::vector<Vec3d> arch;
    for (int y = 0; y < 3; ++y) {
        arch.emplace_back(-100.0, 50.0 * y, 10.0);
        arch.emplace_back(-50.0, 50.0 * y, 210.0);
        arch.emplace_back(0.0, 50.0 * y, 10.0);
    }
    test::add_patch(bsp, 3, 3, arch, test::stone);
    const Scene scene = test::scene_of(bsp);
    EXPECT_TRUE(has_surface_at(scene, {20.0, 20.0, 9.0}));
    double highest = 0.0;
    for (const auto& triangle : scene.triangles) {
        for (const std::uint32_t corner : triangle) {
            const Vec3d& vertex = scene.vertices[corner];
            if (vertex.x() < -20.0 && vertex.x() > -80.0 && vertex.y() >= 0.0 && vertex.y() <= 100.0 &&
                vertex.z() < 200.0)
                highest = std::max(highest, vertex.z());
        }
    }
    EXPECT_NEAR(highest, 110.0, 1.0) << "the curve's middle, half way to its control point";
}

TEST(Q3Scene, SurfacesEndAtTheWorldsBox) {
    q3::Bsp bsp = test::room_map(hall);
    const q3::Model world = bsp.models.front();
    test::add_soup(bsp, {{-30000, 0, 90}, {30000, 0, 90}, {0, 30000, 90}}, test::stone);
    test::add_soup(bsp, {{-30000, 0, 9000}, {30000, 0, 9000}, {0, 30000, 9000}}, test::stone);
    bsp.models.front() = world;
    bsp.models.front().face_count = 2;
    const Scene scene = test::scene_of(bsp);
    EXPECT_LT(area_of(scene), surface_of(hall) * 2.0);
    EXPECT_EQ(skipped_counts(scene)["outside the world's box"], 1U);
}

TEST(Q3Scene, SpawnPointsStandAtEyeHeight) {
    q3::Bsp bsp = test::room_map(hall);
    test::add_spawn_point(bsp, {100.0, 100.0, 24.0});
    test::add_spawn_point(bsp, {-100.0, 100.0, 24.0}, "team_CTF_redspawn");
    test::add_spawn_point(bsp, {0.0, 0.0, 100.0}, "info_player_intermission");
    const Scene scene = test::scene_of(bsp);
    ASSERT_EQ(scene.spawn_points.size(), 2U);
    EXPECT_EQ(scene.spawn_points[0].eye, Vec3d(100.0, 100.0, 59.0));
    EXPECT_DOUBLE_EQ(scene.spawn_points[0].yaw, std::numbers::pi / 2.0);
    EXPECT_EQ(scene.spawn_points[1].kind, "team_CTF_redspawn");
}

TEST(Q3Scene, SpawnEyeStaysBelowTheCeilingAndOutOfSolid) {
    q3::Bsp bsp = test::room_map(hall);
    test::add_box(bsp, Box3d(Vec3d(50.0, 50.0, 40.0), Vec3d(150.0, 150.0, 60.0)), test::stone);
    test::add_spawn_point(bsp, {100.0, 100.0, 24.0});
    test::add_spawn_point(bsp, {-100.0, 100.0, -5.0});
    test::add_box(bsp, Box3d(Vec3d(-150.0, -150.0, 0.0), Vec3d(-50.0, -50.0, 200.0)), test::stone);
    test::add_spawn_point(bsp, {-100.0, -100.0, 100.0});
    const Scene scene = test::scene_of(bsp);
    ASSERT_EQ(scene.spawn_points.size(), 2U);
    EXPECT_EQ(scene.spawn_points[0].eye.z(), 39.0) << "under the low ceiling";
    EXPECT_EQ(scene.spawn_points[1].eye.z(), 30.0) << "sunk into the floor";
    EXPECT_EQ(skipped_counts(scene)["spawn point in solid: info_player_deathmatch"], 1U);
}

TEST(Q3Scene, BrushFacesLieOnTheirBrush) {
    const unsigned seed = 21;
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    q3::Bsp bsp = test::random_map(random, 20);
    bsp.models.front().face_count = 0;  // brushes only
    const Scene scene = test::scene_of(bsp);
    ASSERT_GT(scene.triangles.size(), 100U);
    for (const auto& [a, b, c] : scene.triangles) {
        const Vec3d middle = (scene.vertices[a] + scene.vertices[b] + scene.vertices[c]) / 3.0;
        EXPECT_GT(test::depth_in_solid(scene, middle), -0.02);
    }
}

}  // namespace
}  // namespace camdir::scene
