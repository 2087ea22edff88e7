// Quake 3 maps that break the format: an error of one line each, and no crash.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "scene/quake3/read_scene.hpp"
#include "support/q3_maps.hpp"

namespace camdir::scene {
namespace {

using testing::HasSubstr;

q3::Bsp whole_map() {
    q3::Bsp bsp = test::room_map(Box3d(Vec3d::Zero(), Vec3d::Constant(128.0)));
    test::add_soup(bsp, {{0, 0, 9}, {90, 0, 9}, {0, 90, 9}}, test::stone);
    test::add_patch(bsp, 3, 3, std::vector<Vec3d>(9, Vec3d::Constant(50.0)), test::stone);
    test::add_spawn_point(bsp, {64.0, 64.0, 24.0});
    test::add_entity_model(bsp, "func_static", Vec3d::Zero());
    test::add_box(bsp, Box3d(Vec3d::Constant(20.0), Vec3d::Constant(30.0)), test::stone);
    return bsp;
}

struct Damage {
    const char* name;
    std::function<void(q3::Bsp&)> apply;
    const char* message;
};

class DamagedMap : public testing::TestWithParam<Damage> {};

TEST_P(DamagedMap, IsRefusedWithLumpAndReason) {
    q3::Bsp bsp = whole_map();
    GetParam().apply(bsp);
    const Result<Scene> scene = read_q3_scene(test::encode(bsp));
    ASSERT_FALSE(scene);
    EXPECT_THAT(scene.error().message, HasSubstr(GetParam().message));
    EXPECT_EQ(scene.error().message.find('\n'), std::string::npos);
}

const float nan = std::numeric_limits<float>::quiet_NaN();
const std::int32_t lowest = std::numeric_limits<std::int32_t>::min();
const std::int32_t highest = std::numeric_limits<std::int32_t>::max();

INSTANTIATE_TEST_SUITE_P(
    All, DamagedMap,
    testing::Values(
        Damage{"PlaneNaN", [](q3::Bsp& b) { b.planes[2].normal[1] = nan; }, "lump 2 (planes): element 2"},
        Damage{"PlaneZero",
               [](q3::Bsp& b) {
                   b.planes[2].normal = {0, 0, 0};
               },
               "normal of length 1"},
        Damage{"PlaneFar", [](q3::Bsp& b) { b.planes[2].distance = 1e30F; }, "lump 2 (planes)"},
        Damage{"NodePlane", [](q3::Bsp& b) { b.nodes[1].plane = highest; }, "lump 3 (nodes): element 1"},
        Damage{"NodeCycle", [](q3::Bsp& b) { b.nodes[2].children[1] = 1; }, "expected a tree"},
        Damage{"NodeRoot", [](q3::Bsp& b) { b.nodes[2].children[1] = 0; }, "expected a tree"},
        Damage{"NodeChild", [](q3::Bsp& b) { b.nodes[2].children[0] = 6; }, "child 6 does not exist"},
        Damage{"NodeLeaf", [](q3::Bsp& b) { b.nodes[2].children[0] = lowest; }, "does not exist"},
        Damage{"NoNodes", [](q3::Bsp& b) { b.nodes.clear(); }, "lump 3 (nodes): is empty"},
        Damage{"NoModels", [](q3::Bsp& b) { b.models.clear(); }, "lump 7 (models): is empty"},
        Damage{"ModelBox", [](q3::Bsp& b) { b.models[0].maxs[2] = nan; }, "lump 7 (models): element 0"},
        Damage{"ModelFaces", [](q3::Bsp& b) { b.models[1].face_count = highest; }, "its faces"},
        Damage{"ModelBrushes", [](q3::Bsp& b) { b.models[1].first_brush = lowest; }, "its brushes"},
        Damage{"BrushShader", [](q3::Bsp& b) { b.brushes[3].shader = -1; }, "lump 8 (brushes): element 3"},
        Damage{"BrushSides", [](q3::Bsp& b) { b.brushes[3].side_count = highest; }, "its sides"},
        Damage{"BrushShared",
               [](q3::Bsp& b) {
                   for (auto& brush : b.brushes)
                       brush = {0, static_cast<std::int32_t>(b.brush_sides.size()), 0};
               },
               "shares sides"},
        Damage{"BrushManySides",
               [](q3::Bsp& b) {
                   b.brush_sides.resize(3000, {0, 0});
                   b.brushes[0] = {0, 2000, 0};
               },
               "expected at most 1024"},
        Damage{"SidePlane", [](q3::Bsp& b) { b.brush_sides[4].plane = -1; }, "lump 9 (sides): element 4"},
        Damage{"Vertex", [](q3::Bsp& b) { b.vertices[1].position[0] = INFINITY; }, "lump 10 (vertices)"},
        Damage{"FaceShader", [](q3::Bsp& b) { b.faces[0].shader = 99; }, "lump 13 (faces): element 0"},
        Damage{"FaceVertices", [](q3::Bsp& b) { b.faces[0].vertex_count = highest; }, "its vertices"},
        Damage{"FaceIndices", [](q3::Bsp& b) { b.faces[0].first_index = highest; }, "its indices"},
        Damage{"SoupIndex", [](q3::Bsp& b) { b.indices[0] = 3; }, "index 3 is not below its 3 vertices"},
        Damage{"SoupRest", [](q3::Bsp& b) { b.faces[0].index_count = 2; }, "expected three a triangle"},
        Damage{"PatchEven", [](q3::Bsp& b) { b.faces[1].patch_width = 4; }, "expected odd sides"},
        Damage{"PatchSize", [](q3::Bsp& b) { b.faces[1].patch_width = 65537; }, "expected odd sides"},
        Damage{"Entities", [](q3::Bsp& b) { b.entities = "{ \"classname"; }, "lump 0 (entities): byte 2"},
        Damage{"EntityPair", [](q3::Bsp& b) { b.entities = "{ \"classname\" }"; }, "a quoted string"},
        Damage{"EntityModel", [](q3::Bsp& b) { b.entities = R"({"model" "*2" "classname" "x"})"; },
               "model *2"},
        Damage{"EntityTwice", [](q3::Bsp& b) { b.entities += R"({"model" "*1" "classname" "func_static"})"; },
               "belongs to another entity"},
        Damage{"EntityOrigin",
               [](q3::Bsp& b) { b.entities += R"({"classname" "info_player_start" "origin" "1 nan 3"})"; },
               "origin '1 nan 3': expected three numbers"},
        Damage{"MoverOrigin",
               [](q3::Bsp& b) { b.entities = R"({"classname" "func_door" "model" "*1" "origin" "4 x"})"; },
               "origin '4 x': expected three numbers"}),
    [](const auto& test) { return test.param.name; });

TEST(BrokenMap, OtherVersionsAreNamed) {
    Bytes bytes = test::encode(whole_map());
    bytes[4] = std::byte{47};
    EXPECT_THAT(read_q3_scene(bytes).error().message, HasSubstr("the version is 47"));
}

TEST(BrokenMap, EveryTruncationIsAnErrorOrACompleteMap) {
    const Bytes bytes = test::encode(whole_map());
    for (std::size_t size = 0; size + 4 < bytes.size(); size += 7) {
        EXPECT_FALSE(read_q3_scene(std::span(bytes).first(size))) << size;
    }
}

TEST(BrokenMap, RandomDamageNeverCrashes) {
    const unsigned seed = 31;
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const Bytes bytes = test::encode(whole_map());
    int refused = 0;
    for (int round = 0; round < 3000; ++round) {
        Bytes damaged = bytes;
        for (int i = 0; i < 4; ++i) {
            damaged[random() % damaged.size()] = static_cast<std::byte>(random());
        }
        refused += read_q3_scene(damaged) ? 0 : 1;
    }
    EXPECT_GT(refused, 0);
}

TEST(BrokenMap, FacesThatShareIndicesCannotOutgrowTheFile) {
    q3::Bsp bsp = whole_map();
    std::vector<Vec3d> corners;
    for (int i = 0; i < 3000; ++i) {
        corners.emplace_back(i % 100, i / 100, i % 7);
    }
    test::add_soup(bsp, corners, test::stone);
    const q3::Face soup = bsp.faces.back();
    bsp.faces.insert(bsp.faces.end(), 1000, soup);
    EXPECT_THAT(read_q3_scene(test::encode(bsp)).error().message,
                HasSubstr("which is the limit for a file of this size"));
}

TEST(BrokenMap, DeepTreeNeedsNoStack) {
    q3::Bsp bsp = whole_map();
    const auto first = static_cast<std::int32_t>(bsp.nodes.size());
    bsp.nodes.back().children[1] = first;
    for (std::int32_t i = 0; i < 100'000; ++i) {
        bsp.nodes.push_back({0, {-2, i + 1 < 100'000 ? first + i + 1 : -1}, {}});
    }
    EXPECT_TRUE(read_q3_scene(test::encode(bsp)));
}

}  // namespace
}  // namespace camdir::scene
