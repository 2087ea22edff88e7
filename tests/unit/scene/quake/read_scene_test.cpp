// Which parts of a Quake or GoldSrc map become obstacles.
#include "scene/quake/read_scene.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "support/oracle_twins.hpp"
#include "support/q3_maps.hpp"
#include "support/quake_maps.hpp"
#include "support/scene_measures.hpp"

namespace camdir::scene {
namespace {

using test::area_of;
using test::depth_in_solid;
using test::has_surface_at;
using test::QuakeMap;
using test::skipped_counts;
using test::surface_of;

const Box3d wide_hall(Vec3d(-256.0, -192.0, 0.0), Vec3d(256.0, 192.0, 256.0));
const Box3d iron_crate(Vec3d(10.0, 10.0, 10.0), Vec3d(74.0, 74.0, 74.0));
const Vec3d crate_top(42.0, 42.0, 74.0);

class QuakeScene : public testing::TestWithParam<std::int32_t> {
  protected:
    [[nodiscard]] static QuakeMap room() {
        QuakeMap map;
        map.version = GetParam();
        map.room = wide_hall;
        return map;
    }
};

INSTANTIATE_TEST_SUITE_P(Versions, QuakeScene, testing::Values(quake::version_quake, quake::version_goldsrc),
                         [](const auto& test) { return "Version" + std::to_string(test.param); });

TEST_P(QuakeScene, RoomIsItsInnerSurface) {
    const Scene scene = test::scene_of(room());
    EXPECT_NEAR(area_of(scene), surface_of(wide_hall), 1e-6);
    EXPECT_EQ(scene.vertices.size(), 8U) << "welded";
    EXPECT_EQ(scene.triangles.size(), 12U);
    EXPECT_DOUBLE_EQ(scene.metres_per_unit, 0.0254);
    EXPECT_TRUE(scene.skipped.empty());
}

TEST_P(QuakeScene, SolidAndSkyAreObstaclesAndLiquidsAreNot) {
    struct Kind {
        const char* texture;
        std::int32_t contents;
        bool is_obstacle;
    };
    for (const Kind& kind : {Kind{"stone", quake::solid, true}, Kind{"sky_night", quake::sky, true},
                             Kind{"!water", -3, false}, Kind{"*lava", -5, false}}) {
        SCOPED_TRACE(kind.texture);
        QuakeMap map = room();
        map.boxes = {{iron_crate, kind.texture, kind.contents}};
        const Scene scene = test::scene_of(map);
        EXPECT_EQ(has_surface_at(scene, crate_top), kind.is_obstacle);
        EXPECT_EQ(depth_in_solid(scene, iron_crate.center()) >= 0.0, kind.is_obstacle);
        if (kind.is_obstacle) continue;
        const std::string name = std::string("liquid: ") + kind.texture;
        EXPECT_EQ(skipped_counts(scene)[name], 6U);
        EXPECT_NEAR(test::skipped_areas(scene)[name], surface_of(iron_crate), 1e-3);
    }
}

TEST_P(QuakeScene, StaticEntitiesAreTakenWhereTheyStand) {
    const Vec3d origin(64.0, -32.0, 100.0);
    for (const char* name : {"func_wall", "func_breakable", "func_detail_wall", "func_healthcharger",
                             "func_recharge", "func_button", "func_rot_button", "func_pushable"}) {
        SCOPED_TRACE(name);
        QuakeMap map = room();
        map.entities = {{name, origin, {{iron_crate}}}};
        const Scene scene = test::scene_of(map);
        EXPECT_TRUE(has_surface_at(scene, crate_top + origin));
        EXPECT_FALSE(has_surface_at(scene, crate_top));
        EXPECT_GE(depth_in_solid(scene, iron_crate.center() + origin), 0.0);
        EXPECT_LT(depth_in_solid(scene, iron_crate.center()), 0.0);
        EXPECT_NEAR(area_of(scene), surface_of(wide_hall) + surface_of(iron_crate), 1e-6);
    }
}

TEST_P(QuakeScene, OtherEntitiesAreSkippedByClass) {
    QuakeMap map = room();
    for (const char* name : {"func_door", "func_rotating", "func_wall_toggle", "func_illusionary",
                             "func_detail_illusionary", "trigger_once", "func_of_a_mod"})
        map.entities.push_back({name, Vec3d::Zero(), {{iron_crate}}});
    const Scene scene = test::scene_of(map);
    EXPECT_NEAR(area_of(scene), surface_of(wide_hall), 1e-6);
    EXPECT_LT(depth_in_solid(scene, iron_crate.center()), 0.0);
    EXPECT_THAT(skipped_counts(scene),
                testing::UnorderedElementsAre(testing::Pair("kept as a mover: func_door", 6),
                                              testing::Pair("kept as a mover: func_rotating", 6),
                                              testing::Pair("kept as a mover: func_wall_toggle", 6),
                                              testing::Pair("no obstacle: func_illusionary", 6),
                                              testing::Pair("no obstacle: func_detail_illusionary", 6),
                                              testing::Pair("no obstacle: trigger_once", 6),
                                              testing::Pair("unknown class: func_of_a_mod", 6)));
    EXPECT_NEAR(test::skipped_areas(scene)["kept as a mover: func_door"], surface_of(iron_crate), 1e-3);
}

TEST_P(QuakeScene, MoversAreTheirSolidLeavesInTheirOwnFrame) {
    const Vec3d origin(64.0, -32.0, 100.0);
    const Box3d shelf(Vec3d(-64.0, 0.0, 0.0), Vec3d(-32.0, 32.0, 8.0));
    QuakeMap map = room();
    map.entities = {{"func_door", origin, {{iron_crate}, {shelf}}},
                    {"func_wall", Vec3d(150.0, 0.0, 0.0), {{iron_crate}}}};
    const Scene scene = test::scene_of(map);
    ASSERT_EQ(scene.movers.size(), 1U);
    const Mover& door = scene.movers[0];
    EXPECT_EQ(door.name, "*1");
    EXPECT_EQ(door.kind, "func_door");
    EXPECT_EQ(door.rest, origin);
    const auto is_solid_at = [&](const Vec3d& point) {
        return std::any_of(door.parts.begin(), door.parts.end(), [&](const ConvexPart& part) {
            return part.bounds.contains(point) &&
                   std::all_of(part.planes.begin(), part.planes.end(),
                               [&](const Plane& plane) { return plane.normal.dot(point) <= plane.distance; });
        });
    };
    for (const Box3d& box : {iron_crate, shelf}) {
        EXPECT_TRUE(is_solid_at(box.center()));
        EXPECT_TRUE(is_solid_at(box.min() + Vec3d::Constant(0.1)));
        EXPECT_TRUE(is_solid_at(box.max() - Vec3d::Constant(0.1)));
        EXPECT_FALSE(is_solid_at(box.max() + Vec3d::Constant(0.1)));
    }
    EXPECT_FALSE(is_solid_at((iron_crate.center() + shelf.center()) / 2.0));
}

TEST_P(QuakeScene, MoversWithoutASolidPartAreSkippedByClass) {
    QuakeMap map = room();
    map.entities = {{"func_door", Vec3d::Zero(), {{iron_crate, "trigger"}}},
                    {"func_plat", Vec3d::Zero(), {{iron_crate, "!water", quake::Contents(-3)}}}};
    const Scene scene = test::scene_of(map);
    EXPECT_TRUE(scene.movers.empty());
    EXPECT_EQ(skipped_counts(scene)["mover without a solid part: func_door"], 6U);
    EXPECT_EQ(skipped_counts(scene)["mover without a solid part: func_plat"], 6U);
}

TEST_P(QuakeScene, ClassNamesFromTheFileAreReportedAsShortText) {
    QuakeMap map = room();
    map.entities = {{"func_\xff", Vec3d::Zero(), {{iron_crate}}},
                    {std::string(1000, 'x'), Vec3d::Zero(), {{iron_crate}}},
                    {"", Vec3d::Zero(), {{iron_crate}}}};
    EXPECT_THAT(skipped_counts(test::scene_of(map)),
                testing::UnorderedElementsAre(testing::Pair("unknown class: func_?", 6),
                                              testing::Pair("unknown class: " + std::string(64, 'x'), 6),
                                              testing::Pair("unknown class: without a name", 6)));
}

TEST_P(QuakeScene, ToolTexturesAreSkipped) {
    for (const char* texture : {"clip", "CLIPBevel", "AAATRIGGER", "null", "Skip", "hint", "origin"}) {
        SCOPED_TRACE(texture);
        QuakeMap map = room();
        map.boxes = {{iron_crate, texture, quake::empty}};
        map.entities = {{"func_wall", Vec3d(-150.0, 0.0, 0.0), {{iron_crate, texture}}}};
        const Scene scene = test::scene_of(map);
        EXPECT_NEAR(area_of(scene), surface_of(wide_hall), 1e-6);
        EXPECT_LT(depth_in_solid(scene, iron_crate.center() - Vec3d(150.0, 0.0, 0.0)), 0.0);
        EXPECT_EQ(skipped_counts(scene)[std::string("tool texture: ") + texture], 12U);
    }
}

TEST_P(QuakeScene, ToolTexturesThatCloseRockStay) {
    QuakeMap map = room();
    map.wall_texture = "NULL";
    map.boxes = {{iron_crate, "skip", quake::solid}};
    const Scene scene = test::scene_of(map);
    EXPECT_NEAR(area_of(scene), surface_of(wide_hall) + surface_of(iron_crate), 1e-6);
    EXPECT_TRUE(scene.skipped.empty());
}

TEST_P(QuakeScene, SurfacesAreClosedWhateverFacesTheCompilerKept) {
    QuakeMap map = room();
    map.boxes = {{iron_crate}, {iron_crate.translated(Vec3d(100.0, 0.0, 64.0)), "sky", quake::sky}};
    map.entities = {{"func_wall", Vec3d(-150.0, 0.0, 0.0), {{iron_crate}}}};
    quake::Bsp bsp = test::bsp_of(map);
    // One face stays: an entity without any is no obstacle.
    bsp.models[0].face_count = 0;
    bsp.models[1].face_count = 1;
    const Result<Scene> scene = read_quake_scene(test::encode(bsp));
    ASSERT_TRUE(scene.has_value()) << scene.error().message;
    EXPECT_NEAR(area_of(*scene), surface_of(wide_hall) + 3.0 * surface_of(iron_crate), 1e-6);
    EXPECT_TRUE(has_surface_at(*scene, crate_top - Vec3d(150.0, 0.0, 0.0)));
}

TEST_P(QuakeScene, FacesWithoutRockBehindThemAreSurfaces) {
    QuakeMap map = room();
    map.boxes = {{iron_crate, "stone", quake::empty}};
    const Scene scene = test::scene_of(map);
    EXPECT_NEAR(area_of(scene), surface_of(wide_hall) + surface_of(iron_crate), 1e-6);
    EXPECT_LT(depth_in_solid(scene, iron_crate.center()), 0.0);
}

TEST_P(QuakeScene, SpawnPointsStandAtEyeHeight) {
    QuakeMap map = room();
    map.boxes = {{Box3d(Vec3d(50.0, 50.0, 40.0), Vec3d(150.0, 150.0, 60.0))}};
    map.entities = {{"info_player_start", Vec3d(-100.0, 100.0, 24.0), {}},
                    {"info_player_coop", Vec3d(100.0, 100.0, 24.0), {}},
                    {"info_player_teamspawn", Vec3d(-100.0, 100.0, -5.0), {}},
                    {"info_intermission", Vec3d(0.0, 0.0, 200.0), {}},
                    {"info_player_deathmatch", Vec3d(-100.0, 300.0, 100.0), {}}};
    const Scene scene = test::scene_of(map);
    const double lift = GetParam() == quake::version_quake ? 23.0 : 29.0;
    ASSERT_EQ(scene.spawn_points.size(), 3U);
    EXPECT_EQ(scene.spawn_points[0].eye, Vec3d(-100.0, 100.0, 24.0 + lift));
    EXPECT_DOUBLE_EQ(scene.spawn_points[0].yaw, std::numbers::pi / 2.0);
    EXPECT_EQ(scene.spawn_points[1].kind, "info_player_coop");
    EXPECT_EQ(scene.spawn_points[1].eye.z(), 39.0) << "under the low ceiling";
    EXPECT_EQ(scene.spawn_points[2].eye.z(), -5.0 + lift) << "sunk into the floor";
    EXPECT_EQ(skipped_counts(scene)["spawn point in solid: info_player_deathmatch"], 1U);
}

TEST_P(QuakeScene, VolumesAreTheRockAndNothingElse) {
    const unsigned seed = 41;
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    for (int round = 0; round < 4; ++round) {
        QuakeMap map = room();
        for (int cell = 0; cell < 5; ++cell) {  // one a cell, so that they do not overlap
            const Box3d space(Vec3d(-240.0 + 80.0 * cell, -180.0, 10.0),
                              Vec3d(-170.0 + 80.0 * cell, 180.0, 240.0));
            Box3d box(test::random_point_in(random, space));
            box.extend(test::random_point_in(random, space));
            map.boxes.push_back({Box3d(box.min().array().floor(), box.max().array().ceil())});
        }
        const Scene scene = test::scene_of(map);
        double surface = surface_of(wide_hall);
        for (const test::QuakeBox& box : map.boxes)
            surface += surface_of(box.box);
        EXPECT_NEAR(area_of(scene), surface, 1e-3);
        const Box3d around(wide_hall.min() - Vec3d::Constant(15.0), wide_hall.max() + Vec3d::Constant(15.0));
        for (int i = 0; i < 2000; ++i) {
            const Vec3d point = test::random_point_in(random, around);
            const bool in_rock = !wide_hall.contains(point) ||
                                 std::any_of(map.boxes.begin(), map.boxes.end(),
                                             [&](const auto& b) { return b.box.contains(point); });
            ASSERT_EQ(depth_in_solid(scene, point) >= 0.0, in_rock) << point.transpose();
        }
    }
}

}  // namespace
}  // namespace camdir::scene
