#include "bake/inside.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bake/clearance.hpp"
#include "support/solid_scenes.hpp"

namespace camdir::bake {
namespace {

// One triangle around each centre.
MedialMesh islands(const std::vector<Vec3f>& centres) {
    MedialMesh mesh;
    for (const Vec3f& centre : centres) {
        const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
        mesh.vertices.insert(mesh.vertices.end(), {centre, centre + Vec3f(8, 0, 0), centre + Vec3f(0, 9, 0)});
        mesh.triangles.push_back({first, first + 1, first + 2});
    }
    return mesh;
}

std::vector<std::uint32_t> kept_of(MedialMesh mesh, const scene::Scene& scene) {
    Stage stage("inside", {}, {});
    const auto clearance = clearances(mesh, Obstacles(scene), stage).value();
    EXPECT_TRUE(keep_inside(mesh, clearance, scene, Solids(scene), stage));
    std::vector<std::uint32_t> kept;
    for (const freespace::Triangle& t : mesh.triangles)
        kept.push_back(t.a / 3);
    return kept;
}

TEST(KeepInside, KeepsThePartsOfTheSpawnPoints) {
    test::SolidScene room = test::box_room();
    room.spawn({30, 160, 64});
    const MedialMesh mesh = islands({{90, 90, 60}, {220, 30, 20}, {25, 150, 60}});
    EXPECT_THAT(kept_of(mesh, room.scene()), testing::ElementsAre(0U, 2U));
}

TEST(KeepInside, FollowsSharedVertices) {
    const test::SolidScene room = test::box_room();
    MedialMesh mesh = islands({{90, 90, 60}, {220, 30, 20}});
    mesh.triangles.push_back({2, 4, 3});
    EXPECT_THAT(kept_of(mesh, room.scene()), testing::ElementsAre(0U, 1U, 0U));
}

TEST(KeepInside, DropsTrianglesWithACornerInASolid) {
    // A solid whose surface is missing from the obstacles: the clearance does not see it.
    test::SolidScene room = test::box_room();
    scene::Scene scene = room.add(Box3d(Vec3d(95, 85, 50), Vec3d(120, 110, 70))).scene();
    scene.triangles.resize(scene.triangles.size() - 12);
    scene.spawn_points[0].eye = {80, 100, 60};
    MedialMesh mesh = islands({{90, 90, 60}, {60, 100, 60}});
    mesh.triangles.push_back({0, 4, 5});
    EXPECT_THAT(kept_of(mesh, scene), testing::ElementsAre(1U, 0U));
}

TEST(KeepInside, WithoutSpawnPointsKeepsTheLargestPart) {
    scene::Scene scene = test::box_room().scene();
    scene.spawn_points.clear();
    MedialMesh mesh = islands({{90, 90, 60}, {150, 60, 50}, {200, 150, 30}});
    mesh.vertices[4] += Vec3f(30, 0, 0);
    EXPECT_THAT(kept_of(mesh, scene), testing::ElementsAre(1U));
}

TEST(KeepInside, WithoutSpawnPointsWhatReachesOutOfTheBoundsDoesNotCount) {
    scene::Scene scene = test::box_room().scene();
    scene.spawn_points.clear();
    scene.bounds.extend(Vec3d(100, 100, 300));
    MedialMesh mesh = islands({{90, 90, 60}, {90, 90, 250}});
    mesh.vertices[4] += Vec3f(30, 0, 0);
    EXPECT_THAT(kept_of(mesh, scene), testing::ElementsAre(0U));
}

TEST(KeepInside, WhereAllReachesOutTheLargestPartStays) {
    scene::Scene scene = test::box_room().scene();
    scene.spawn_points.clear();
    scene.bounds = Box3d(Vec3d(80, 80, 50), Vec3d(220, 170, 70));
    MedialMesh mesh = islands({{90, 90, 60}, {150, 90, 60}, {200, 150, 60}});
    mesh.vertices[4] += Vec3f(30, 0, 0);
    EXPECT_THAT(kept_of(mesh, scene), testing::ElementsAre(1U));
}

TEST(KeepInside, FailsWhenNoSpawnPointIsInTheFreespace) {
    scene::Scene scene = test::box_room().scene();
    scene.spawn_points[0].eye = {-8, 100, 50};
    MedialMesh mesh = islands({{90, 90, 60}});
    Stage stage("inside", {}, {});
    const auto clearance = clearances(mesh, Obstacles(scene), stage).value();
    const auto failed = keep_inside(mesh, clearance, scene, Solids(scene), stage);
    ASSERT_FALSE(failed);
    EXPECT_THAT(failed.error().message, testing::HasSubstr("none of the 1 spawn points"));
}

}  // namespace
}  // namespace camdir::bake
