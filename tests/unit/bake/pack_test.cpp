#include "bake/pack.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace camdir::bake {
namespace {

scene::Scene scene_of(double metres_per_unit) {
    scene::Scene scene;
    scene.source = "made.map";
    scene.metres_per_unit = metres_per_unit;
    scene.bounds = Box3d(Vec3d(-100, -100, -100), Vec3d(100, 100, 100));
    return scene;
}

// Two triangles at one edge, and a third at one vertex.
MedialMesh strip() {
    return {{{0, 0, 0}, {40, 0, 0}, {0, 40, 0}, {40, 40, 0}, {80, 40, 0}, {80, 80, 0}},
            {{0, 1, 2}, {1, 3, 2}, {3, 4, 5}}};
}

Result<freespace::Contents> packed(const std::vector<float>& free_distance, double metres_per_unit = 0.0254) {
    Stage stage("pack", {}, {});
    return pack(strip(), free_distance, scene_of(metres_per_unit), stage);
}

TEST(Pack, FreeDistancesOfRoundingCountAsNone) {
    const auto contents = packed({9.0F, 2.8e-14F, 0.9e-6F, 1.1e-6F, -3.0F, 2.8e-14F}).value();
    ASSERT_EQ(contents.vertices.size(), 6U);
    std::vector<float> stored;
    for (const freespace::Vertex& vertex : contents.vertices)
        stored.push_back(vertex.free_distance);
    EXPECT_THAT(stored, testing::ElementsAre(9.0F, 0.0F, 0.0F, 1.1e-6F, -3.0F, 0.0F));
}

TEST(Pack, DropsTrianglesWithoutFreeDistance) {
    const auto contents = packed({9.0F, 0.0F, 0.5e-6F, 2.8e-14F, 0.0F, -1.0F}).value();
    EXPECT_EQ(contents.vertices.size(), 3U);
    ASSERT_EQ(contents.triangles.size(), 1U);
    EXPECT_EQ(contents.spawn_points.at(0).eye, Vec3f(0, 0, 0)) << "the widest ball";
    const auto empty = packed(std::vector<float>(6, 2.8e-14F));
    ASSERT_FALSE(empty);
    EXPECT_THAT(empty.error().message, testing::HasSubstr("made.map: no free space"));
}

TEST(Pack, TheThresholdIsTheSameLengthWhateverTheUnit) {
    const auto contents = packed(std::vector<float>(6, 0.9e-6F), 1.0).value();
    for (const freespace::Vertex& vertex : contents.vertices)
        EXPECT_EQ(vertex.free_distance, 0.9e-6F);
}

}  // namespace
}  // namespace camdir::bake
