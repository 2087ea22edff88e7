// Quake and GoldSrc maps that break the format: an error of one line each, and no crash.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <random>

#include "scene/quake/read_scene.hpp"
#include "support/bsp_writer.hpp"
#include "support/quake_maps.hpp"

namespace camdir::scene {
namespace {

using testing::HasSubstr;

quake::Bsp whole_map() {
    test::QuakeMap map;
    map.room = Box3d(Vec3d::Zero(), Vec3d::Constant(128.0));
    map.boxes = {{Box3d(Vec3d::Constant(20.0), Vec3d::Constant(30.0))}};
    map.entities = {{"info_player_start", Vec3d(64.0, 64.0, 24.0), {}},
                    {"func_wall", Vec3d::Zero(), {{Box3d(Vec3d::Constant(80.0), Vec3d::Constant(90.0))}}}};
    return test::bsp_of(map);
}

struct Damage {
    const char* name;
    std::function<void(quake::Bsp&)> apply;
    const char* message;
};

class DamagedQuakeMap : public testing::TestWithParam<Damage> {};

TEST_P(DamagedQuakeMap, IsRefusedWithLumpAndReason) {
    quake::Bsp bsp = whole_map();
    GetParam().apply(bsp);
    const Result<Scene> scene = read_quake_scene(test::encode(bsp));
    ASSERT_FALSE(scene);
    EXPECT_THAT(scene.error().message, HasSubstr(GetParam().message));
    EXPECT_EQ(scene.error().message.find('\n'), std::string::npos);
}

const std::int32_t lowest = std::numeric_limits<std::int32_t>::min();
const std::int32_t highest = std::numeric_limits<std::int32_t>::max();

INSTANTIATE_TEST_SUITE_P(
    All, DamagedQuakeMap,
    testing::Values(
        Damage{"PlaneNaN", [](quake::Bsp& b) { b.planes[2].normal[1] = NAN; },
               "lump 1 (planes): element 2 at byte"},
        Damage{"PlaneFar", [](quake::Bsp& b) { b.planes[2].distance = 1e30F; }, "distance below 2^20"},
        Damage{"Vertex", [](quake::Bsp& b) { b.vertices[1].position[0] = INFINITY; }, "lump 3 (vertices)"},
        Damage{"NodePlane", [](quake::Bsp& b) { b.nodes[1].plane = highest; }, "lump 5 (nodes): element 1"},
        Damage{"NodeCycle", [](quake::Bsp& b) { b.nodes[0].children[0] = 0; }, "expected a tree"},
        Damage{"NodeTwoParents",
               [](quake::Bsp& b) {
                   b.nodes[0].children = {3, 3};
               },
               "expected a tree"},
        Damage{"RootIsChild",
               [](quake::Bsp& b) {
                   b.nodes[0].children[0] = static_cast<std::uint16_t>(b.models[0].head_nodes[0]);
               },
               "expected a tree of its own"},
        Damage{"RootTwice", [](quake::Bsp& b) { b.models[1].head_nodes[0] = b.models[0].head_nodes[0]; },
               "lump 14 (models): element 1"},
        Damage{"RootMissing", [](quake::Bsp& b) { b.models[1].head_nodes[0] = highest; }, "does not exist"},
        Damage{"RootLeaf", [](quake::Bsp& b) { b.models[1].head_nodes[0] = lowest; }, "does not exist"},
        Damage{"NodeLeaf", [](quake::Bsp& b) { b.nodes[2].children[0] = 40000; }, "does not exist"},
        Damage{"NoNodes", [](quake::Bsp& b) { b.nodes.clear(); }, "does not exist"},
        Damage{"NoModels", [](quake::Bsp& b) { b.models.clear(); }, "lump 14 (models): is empty"},
        Damage{"ModelBox", [](quake::Bsp& b) { b.models[0].maxs[2] = NAN; }, "lump 14 (models): element 0"},
        Damage{"ModelFaces", [](quake::Bsp& b) { b.models[1].face_count = highest; }, "its faces"},
        Damage{"ModelShares",
               [](quake::Bsp& b) {
                   b.models[1].first_face = 0;
                   b.models[1].face_count = b.models[0].face_count;
               },
               "shares faces"},
        Damage{"Texture", [](quake::Bsp& b) { b.texture_infos[0].texture = 1; }, "texture 1 does not exist"},
        Damage{"FacePlane", [](quake::Bsp& b) { b.faces[3].plane = 65535; }, "lump 7 (faces): element 3"},
        Damage{"FaceTexture", [](quake::Bsp& b) { b.faces[3].texture_info = 9; }, "texture info 9"},
        Damage{"FaceEdges", [](quake::Bsp& b) { b.faces[3].first_edge = highest; }, "its edges"},
        Damage{"FaceShares",
               [](quake::Bsp& b) {
                   for (auto& face : b.faces) {
                       face.first_edge = 0;
                       face.edge_count = 8;
                   }
               },
               "shares edges"},
        Damage{"Edge", [](quake::Bsp& b) { b.edges[5].vertices[1] = 65535; }, "lump 12 (edges): element 5"},
        Damage{"SurfaceEdge", [](quake::Bsp& b) { b.surface_edges[7] = lowest; },
               "lump 13 (surface edges): element 7"},
        Damage{"Entities", [](quake::Bsp& b) { b.entities = "{ \"classname"; }, "lump 0 (entities): byte 2"},
        Damage{"EntityModel", [](quake::Bsp& b) { b.entities = R"({"model" "*2" "classname" "x"})"; },
               "model *2"},
        Damage{"EntityTwice",
               [](quake::Bsp& b) { b.entities += R"({"model" "*1" "classname" "func_wall"})"; },
               "belongs to another entity"},
        Damage{"EntityOrigin",
               [](quake::Bsp& b) { b.entities += R"({"classname" "info_player_start" "origin" "1 nan 3"})"; },
               "origin '1 nan 3': expected three numbers"},
        Damage{"MoverOrigin",
               [](quake::Bsp& b) { b.entities = R"({"classname" "func_door" "model" "*1" "origin" "4 x"})"; },
               "origin '4 x': expected three numbers"}),
    [](const auto& test) { return test.param.name; });

TEST(BrokenQuakeMap, OtherVersionsAreNamed) {
    Bytes bytes = test::encode(whole_map());
    bytes[0] = std::byte{31};
    EXPECT_THAT(read_quake_scene(bytes).error().message,
                HasSubstr("expected version 29 (Quake) or 30 (GoldSrc); the version is 31"));
}

TEST(BrokenQuakeMap, TexturesMustFit) {
    const Bytes whole = test::encode(whole_map());
    std::int32_t place = 0;
    std::memcpy(&place, whole.data() + 4 + 8 * 2, sizeof place);
    for (const std::int32_t word : {0, 1}) {
        Bytes bytes = whole;
        std::memcpy(bytes.data() + place + 4 * word, &highest, sizeof highest);
        EXPECT_THAT(read_quake_scene(bytes).error().message, HasSubstr("lump 2 (textures)")) << word;
    }
}

TEST(BrokenQuakeMap, EveryTruncationIsAnError) {
    const Bytes bytes = test::encode(whole_map());
    for (std::size_t size = 0; size < bytes.size(); size += 7) {
        EXPECT_FALSE(read_quake_scene(std::span(bytes).first(size))) << size;
    }
}

TEST(BrokenQuakeMap, RandomDamageNeverCrashes) {
    const unsigned seed = 37;
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const Bytes bytes = test::encode(whole_map());
    int refused = 0;
    for (int round = 0; round < 2000; ++round) {
        Bytes damaged = bytes;
        for (int i = 0; i < 4; ++i) {
            damaged[random() % damaged.size()] = static_cast<std::byte>(random());
        }
        refused += read_quake_scene(damaged) ? 0 : 1;
    }
    EXPECT_GT(refused, 0);
}

TEST(BrokenQuakeMap, DeepTreeNeedsNoStack) {
    quake::Bsp bsp = whole_map();
    const std::size_t first = bsp.nodes.size();
    const auto leaf = bsp.nodes[0].children[1];
    bsp.nodes[0].children[1] = static_cast<std::uint16_t>(first);
    for (std::size_t i = first; i < 60'000; ++i) {
        bsp.nodes.push_back({0, {leaf, i + 1 < 60'000 ? static_cast<std::uint16_t>(i + 1) : leaf}, {}, 0, 0});
    }
    EXPECT_TRUE(read_quake_scene(test::encode(bsp)));
}

// A chain of planes around a ball: every leaf has one plane more than the one before.
TEST(BrokenQuakeMap, PlacesOfTooManyPlanesAreRefused) {
    quake::Bsp bsp = whole_map();
    const std::size_t first = bsp.nodes.size();
    bsp.leaves.push_back({quake::empty, {}});
    const auto leaf = static_cast<std::uint16_t>(65536 - bsp.leaves.size());
    const std::size_t chain = 2000;
    for (std::size_t i = 0; i < chain; ++i) {
        const double height = 1.0 - 2.0 * (static_cast<double>(i) + 0.5) / static_cast<double>(chain);
        const double turn = 2.399963 * static_cast<double>(i);  // the golden angle: evenly over the sphere
        const double radius = std::sqrt(1.0 - height * height);
        const Vec3d normal(radius * std::cos(turn), radius * std::sin(turn), height);
        const double distance = normal.dot(Vec3d::Constant(64.0)) + 20.0;
        const auto plane = static_cast<std::int32_t>(bsp.planes.size());
        bsp.planes.push_back(
            {{static_cast<float>(normal.x()), static_cast<float>(normal.y()), static_cast<float>(normal.z())},
             static_cast<float>(distance),
             0});
        const std::size_t next = first + i + 1;
        bsp.nodes.push_back(
            {plane, {leaf, next < first + chain ? static_cast<std::uint16_t>(next) : leaf}, {}, 0, 0});
    }
    bsp.models[0].head_nodes[0] = static_cast<std::int32_t>(first);
    EXPECT_THAT(read_quake_scene(test::encode(bsp)).error().message, HasSubstr("more than 256 planes"));
}

// Slices of rock along y look across the plane x = 64 at slices of air along z: each face is cut by all of
// them.
TEST(BrokenQuakeMap, SurfacesOfTooManyPartsAreRefused) {
    quake::Bsp bsp = whole_map();
    const auto cut = [&](const Vec3d& normal, double distance, std::uint16_t front, std::uint16_t back) {
        bsp.nodes.push_back({static_cast<std::int32_t>(bsp.planes.size()), {front, back}, {}, 0, 0});
        bsp.planes.push_back({test::floats(normal), static_cast<float>(distance), 0});
        return static_cast<std::uint16_t>(bsp.nodes.size() - 1);
    };
    const auto slices = [&](const Vec3d& normal, std::int32_t contents) {
        bsp.leaves.push_back({contents, {}});
        const auto leaf = static_cast<std::uint16_t>(65536 - bsp.leaves.size());
        std::uint16_t child = leaf;
        for (int i = 0; i < 1000; ++i)
            child = cut(normal, 0.125 * i, leaf, child);
        return child;
    };
    const std::uint16_t rock = slices(Vec3d::UnitY(), quake::solid);
    const std::uint16_t air = slices(Vec3d::UnitZ(), quake::empty);
    bsp.models[0].head_nodes[0] = cut(Vec3d::UnitX(), 64.0, rock, air);
    const Result<Scene> scene = read_quake_scene(test::encode(bsp));
    ASSERT_FALSE(scene);
    EXPECT_THAT(scene.error().message, HasSubstr("in too many parts for a file of this size"));
}

}  // namespace
}  // namespace camdir::scene
