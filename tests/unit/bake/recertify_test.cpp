#include "bake/recertify.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "bake/bake.hpp"
#include "support/solid_scenes.hpp"

namespace camdir::bake {
namespace {

constexpr double tolerance = 0.001;

Result<void> looked_at(const freespace::Contents& contents, const test::SolidScene& scene,
                       double offset = 0.0) {
    Stage stage("recertify", {}, {});
    return recertify(contents, Obstacles(scene.scene()), offset, tolerance, "room", stage);
}

freespace::Contents baked(const test::SolidScene& scene, double loss) {
    Parameters parameters;
    parameters.loss = loss;
    return bake(scene.scene(), parameters, {}, {}).value().contents;
}

TEST(Recertify, AcceptsWhatIsBaked) {
    for (const auto& scene : {test::box_room(), test::pillar_room(), test::two_rooms()})
        for (const double loss : {0.0, Parameters{}.loss})
            EXPECT_TRUE(looked_at(baked(scene, loss), scene));
}

// A vertex between floor and ceiling is bound by both: any free distance that its clearance does not cover
// must be found, whichever vertex has it.
TEST(Recertify, FindsEveryVertexThatIsGivenTooMuch) {
    const test::SolidScene room = test::pillar_room();
    const freespace::Contents good = baked(room, Parameters{}.loss);
    std::mt19937 random(5);
    std::uniform_int_distribution<std::size_t> any(0, good.vertices.size() - 1);
    for (int i = 0; i < 50; ++i) {
        freespace::Contents bad = good;
        freespace::Vertex& vertex = bad.vertices[any(random)];
        const double clearance = room.clearance(vertex.position().cast<double>());
        vertex.free_distance = static_cast<float>(clearance + 2.0 * tolerance);
        const auto found = looked_at(bad, room);
        ASSERT_FALSE(found);
        EXPECT_THAT(found.error().message,
                    testing::AllOf(testing::StartsWith("room: triangle "),
                                   testing::HasSubstr("map units into an obstacle near (")));
    }
}

TEST(Recertify, FindsAVertexThatIsMoved) {
    const test::SolidScene room = test::pillar_room();
    freespace::Contents contents = baked(room, Parameters{}.loss);
    const auto widest =
        std::max_element(contents.vertices.begin(), contents.vertices.end(),
                         [](const auto& a, const auto& b) { return a.free_distance < b.free_distance; });
    widest->z += 1.0F;
    EXPECT_FALSE(looked_at(contents, room));
}

TEST(Recertify, AddsTheOffsetToEveryBall) {
    const test::SolidScene room = test::box_room();
    freespace::Contents contents = baked(room, 0.0);
    EXPECT_FALSE(looked_at(contents, room, 2.0));
    for (freespace::Vertex& vertex : contents.vertices)
        vertex.free_distance -= 2.0F;
    EXPECT_TRUE(looked_at(contents, room, 2.0));
}

}  // namespace
}  // namespace camdir::bake
