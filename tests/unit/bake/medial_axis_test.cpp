#include "bake/medial_axis.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <random>

#include "support/bake_twins.hpp"
#include "support/solid_scenes.hpp"

namespace camdir::bake {
namespace {

using test::SolidScene;

std::vector<Vec3d> medial_axis_of(const scene::Scene& scene, const Probing& probing) {
    const Obstacles obstacles(scene);
    const Solids solids(scene);
    Stage stage("medial axis", {}, {});
    return medial_axis(obstacles, solids, probing, stage).value();
}

TEST(ShrinkingBall, IsTheLargestEmptyBallThatTouches) {
    const SolidScene room = test::pillar_room();
    const Obstacles obstacles(room.scene());
    std::mt19937 random(30);
    std::uniform_real_distribution<double> x(0.0, 256.0);
    std::uniform_real_distribution<double> y(0.0, 192.0);
    for (int round = 0; round < 300; ++round) {
        const Vec3d q(x(random), y(random), 0.0);
        if (Box3d(Vec3d(150, 60, 0), Vec3d(182, 92, 128)).contains(q)) continue;
        const double reach = round % 2 == 0 ? 500.0 : 40.0;
        const double radius = shrinking_ball_radius(q, Vec3d::UnitZ(), reach, obstacles);
        ASSERT_LE(radius, reach);
        const auto free_at = [&](double r) { return room.clearance(q + r * Vec3d::UnitZ()); };
        EXPECT_GE(free_at(radius), radius * (1.0 - 1e-3)) << "empty, round " << round;
        if (radius < reach) {
            EXPECT_LT(free_at(radius * 1.01), radius * 1.01 * (1.0 - 1e-6)) << "the largest";
        }
    }
}

TEST(ShrinkingBall, OfAFreeSideHasTheLargestRadius) {
    scene::Scene floor;
    floor.vertices = {{0, 0, 0}, {100, 0, 0}, {0, 100, 0}};
    floor.triangles = {{0, 1, 2}};
    EXPECT_EQ(shrinking_ball_radius({20, 20, 0}, Vec3d::UnitZ(), 77.0, Obstacles(floor)), 77.0);
}

TEST(MedialAxis, OfARoomHasEqualDistancesToTwoWalls) {
    const auto points = medial_axis_of(test::box_room().scene(), {16.0, 300.0});
    ASSERT_GT(points.size(), 100U);
    for (const Vec3d& p : points) {
        std::array<double, 6> to_wall{p.x(), 256.0 - p.x(), p.y(), 192.0 - p.y(), p.z(), 128.0 - p.z()};
        std::sort(to_wall.begin(), to_wall.end());
        EXPECT_GT(to_wall[0], 0.0) << "inside the room, not inside the walls";
        EXPECT_NEAR(to_wall[0], to_wall[1], 1e-2 * to_wall[0]) << p.transpose();
    }
}

TEST(MedialAxis, ComesNearEveryPointOfItAsDenselyAsItIsNarrow) {
    const auto points = medial_axis_of(test::box_room().scene(), {16.0, 300.0});
    // The medial surface of the box: the middle rectangle z = 64 and the bisectors of its edges.
    std::mt19937 random(31);
    std::uniform_real_distribution<double> along(64.0, 128.0);
    for (int round = 0; round < 100; ++round) {
        EXPECT_LT(test::distance_to_nearest({along(random) + 32.0, 96.0, 64.0}, points), 40.0);
        const double t = along(random) / 4.0;
        EXPECT_LT(test::distance_to_nearest({along(random), t, t}, points), 24.0);
    }
}

TEST(MedialAxis, IsFoundInsideADoorThatIsSmallOnItsWall) {
    SolidScene rooms(Box3d(Vec3d(-600, -500, 0), Vec3d(600, 500, 400)));
    rooms.add(Box3d(Vec3d(-8, -500, 0), Vec3d(8, -24, 400)));
    rooms.add(Box3d(Vec3d(-8, 24, 0), Vec3d(8, 500, 400)));
    rooms.add(Box3d(Vec3d(-8, -24, 80), Vec3d(8, 24, 400)));
    const auto points = medial_axis_of(rooms.scene(), {32.0, 256.0});
    EXPECT_LT(test::distance_to_nearest({0, 0, 40}, points), 20.0);
}

TEST(MedialAxis, HasNoPointsOfBallsBeyondTheReach) {
    const auto points = medial_axis_of(test::box_room().scene(), {16.0, 40.0});
    EXPECT_GT(points.size(), 0U);
    for (const Vec3d& p : points)
        EXPECT_LT(test::box_room().clearance(p), 40.0);
}

TEST(MedialAxis, EndsSoonAfterTheMaximumNumberOfPoints) {
    const scene::Scene room = test::box_room().scene();
    const std::size_t all = medial_axis_of(room, {0.5, 300.0}).size();
    const std::size_t some = medial_axis_of(room, {0.5, 300.0, 1000}).size();
    EXPECT_GT(some, 1000U);
    EXPECT_LT(some, 5000U);
    EXPECT_GT(all, 5000U);
}

TEST(MedialAxis, StopsOnRequest) {
    const scene::Scene scene = test::box_room().scene();
    std::stop_source stop;
    stop.request_stop();
    Stage stage("medial axis", {}, stop.get_token());
    const auto interrupted = medial_axis(Obstacles(scene), Solids(scene), {16.0, 300.0}, stage);
    ASSERT_FALSE(interrupted);
    EXPECT_EQ(interrupted.error().code, ErrorCode::interrupted);
}

}  // namespace
}  // namespace camdir::bake
