// Bakes of point clouds: free space stays d0 away from every point.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "bake/bake.hpp"
#include "freespace/distance.hpp"
#include "freespace/freespace.hpp"
#include "scene/cloud/read_scene.hpp"
#include "support/clouds.hpp"

namespace camdir::bake {
namespace {

const Box3d room(Vec3d(-2.0, -1.5, 0.0), Vec3d(2.0, 1.5, 2.0));
constexpr double spacing = 0.1;

scene::Scene scene_of(const std::vector<Vec3d>& points, const std::vector<Vec3d>& seeds = {}) {
    auto scene =
        scene::read_cloud_scene(test::bytes_of(test::xyz_of(points)), scene::CloudFormat::xyz, {}).value();
    for (const Vec3d& seed : seeds)
        scene.spawn_points.push_back({seed, 0.0, "seed"});
    return scene;
}

freespace::Freespace bake_of(const scene::Scene& scene, const Parameters& parameters = {}) {
    const auto baked = bake(scene, parameters, {}, {}).value();
    return freespace::Freespace::parse(freespace::encode(baked.contents), "test").value();
}

double distance_to(const std::vector<Vec3d>& points, const Vec3d& place) {
    double nearest = 1e9;
    for (const Vec3d& point : points)
        nearest = std::min(nearest, (point - place).norm());
    return nearest;
}

TEST(CloudBake, RoomsCentreHasTheDistanceToItsWallsLessD0) {
    const scene::Scene scene = scene_of(test::walls_of(room, spacing));
    const freespace::Freespace baked = bake_of(scene);
    const double d0 = baked.metadata().d0;
    EXPECT_NEAR(d0, scene.point_spacing, 1e-6);
    EXPECT_LT(d0, 1.5 * spacing);

    const auto centre = freespace::distance(baked, room.center().cast<float>());
    const double truth = distance_to(scene.points, room.center()) - d0;
    EXPECT_LE(centre.value, truth + 1e-4);
    EXPECT_GE(centre.value, truth - 0.03);
}

TEST(CloudBake, BallsKeepD0AwayFromEveryPoint) {
    std::vector<Vec3d> points = test::walls_of(room, spacing);
    const auto pillar = test::walls_of(Box3d(Vec3d(0.4, 0.3, 0.0), Vec3d(0.8, 0.7, 2.0)), spacing);
    points.insert(points.end(), pillar.begin(), pillar.end());
    std::mt19937 random(7);
    std::uniform_real_distribution<double> noise(-0.01, 0.01);
    for (Vec3d& point : points)
        point += Vec3d(noise(random), noise(random), noise(random));
    const scene::Scene scene = scene_of(points);
    const freespace::Freespace baked = bake_of(scene);
    EXPECT_GT(baked.triangles().size(), 100U);
    for (const freespace::Vertex& vertex : baked.vertices()) {
        const double clear =
            distance_to(scene.points, vertex.position().cast<double>()) - baked.metadata().d0;
        ASSERT_LE(vertex.free_distance, clear + 1e-5);
        ASSERT_TRUE(vertex.free_distance <= 0.0F || room.contains(vertex.position().cast<double>()));
    }
}

TEST(CloudBake, WithoutSeedsTheLargestPartStaysAndSaysWhereItIs) {
    std::vector<Vec3d> points = test::walls_of(room, spacing);
    const Box3d other(Vec3d(5.0, 0.0, 0.0), Vec3d(6.5, 1.5, 1.5));
    const auto small = test::walls_of(other, spacing);
    points.insert(points.end(), small.begin(), small.end());

    const freespace::Freespace largest = bake_of(scene_of(points));
    ASSERT_EQ(largest.spawn_points().size(), 1U);
    EXPECT_TRUE(room.contains(largest.spawn_points()[0].eye.cast<double>()));
    EXPECT_FALSE(freespace::distance(largest, other.center().cast<float>()).covered());

    const freespace::Freespace seeded = bake_of(scene_of(points, {other.center()}));
    EXPECT_TRUE(freespace::distance(seeded, other.center().cast<float>()).covered());
    EXPECT_FALSE(freespace::distance(seeded, room.center().cast<float>()).covered());
}

TEST(CloudBake, SaysWhatItWasMadeFrom) {
    auto scene = scene_of(test::walls_of(room, 0.25));
    scene.skipped.push_back({"outliers", "", 3});
    scene.options.seeds = {{0.5, 0.0, 1.0}};
    const freespace::Metadata metadata = bake_of(scene, {.d0 = 8.0}).metadata();
    EXPECT_NE(metadata.parameters.find(R"json("kind": "point cloud (XYZ)")json"), std::string::npos);
    EXPECT_NE(metadata.parameters.find(R"("seeds": [[0.5, 0, 1]])"), std::string::npos);
    EXPECT_TRUE(
        std::any_of(metadata.counts.begin(), metadata.counts.end(), [](const freespace::Count& count) {
            return count.stage == "left out" && count.what == "outliers" && count.value == 3.0;
        }));
    EXPECT_NEAR(metadata.d0, 8.0 * 0.0254, 1e-6);
}

}  // namespace
}  // namespace camdir::bake
