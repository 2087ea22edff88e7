// The files of `export`, taken apart by the rules of their formats.
#include <gtest/gtest.h>

#include <cstring>
#include <nlohmann/json.hpp>
#include <random>

#include "export/glb.hpp"
#include "export/ply.hpp"
#include "support/freespace_meshes.hpp"

namespace camdir::exports {
namespace {

using freespace::Freespace;
using nlohmann::json;

template <class Value>
Value value_at(const Bytes& bytes, std::size_t at) {
    Value value;
    EXPECT_LE(at + sizeof value, bytes.size());
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
}

std::string text_of(const Bytes& bytes, std::size_t begin, std::size_t size) {
    return {reinterpret_cast<const char*>(bytes.data()) + begin, size};
}

Freespace random_mesh() {
    std::mt19937 random(5);
    return test::make_freespace(test::random_contents(random, 12, 9, 40));
}

TEST(Ply, HoldsTheVerticesAndTriangles) {
    const Freespace mesh = random_mesh();
    const Bytes file = to_ply(mesh);
    const std::string end = "end_header\n";
    const std::size_t header = text_of(file, 0, file.size()).find(end) + end.size();
    ASSERT_EQ(file.size(), header + mesh.vertices().size() * 16 + mesh.triangles().size() * 13);
    for (std::size_t i = 0; i < mesh.vertices().size(); ++i) {
        EXPECT_EQ(value_at<float>(file, header + 16 * i), mesh.vertices()[i].x);
        EXPECT_EQ(value_at<float>(file, header + 16 * i + 12), mesh.vertices()[i].free_distance);
    }
    const std::size_t faces = header + mesh.vertices().size() * 16;
    for (std::size_t i = 0; i < mesh.triangles().size(); ++i) {
        EXPECT_EQ(value_at<std::uint8_t>(file, faces + 13 * i), 3);
        EXPECT_EQ(value_at<std::uint32_t>(file, faces + 13 * i + 9), mesh.triangles()[i].c);
    }
}

// The JSON chunk of a binary glTF file, after a check of its chunks.
json document_of(const Bytes& file) {
    EXPECT_EQ(text_of(file, 0, 4), "glTF");
    EXPECT_EQ(value_at<std::uint32_t>(file, 4), 2U);
    EXPECT_EQ(value_at<std::uint32_t>(file, 8), file.size());
    const auto length = value_at<std::uint32_t>(file, 12);
    EXPECT_EQ(text_of(file, 16, 4), "JSON");
    EXPECT_EQ(length % 4, 0U);
    json document = json::parse(text_of(file, 20, length));
    if (document.contains("buffers")) {
        EXPECT_EQ(file.size(), 20 + length + 8 + document["buffers"][0]["byteLength"].get<std::size_t>());
    }
    return document;
}

TEST(Glb, HoldsTheMeshTheRoadmapAndTheSpawnPoints) {
    const Freespace mesh = random_mesh();
    const json document = document_of(to_glb(mesh).value());
    ASSERT_EQ(document["meshes"].size(), 2U);
    const json& triangles = document["meshes"][0]["primitives"][0];
    EXPECT_EQ(document["meshes"][0]["name"], "medial mesh");
    EXPECT_EQ(document["accessors"][triangles["indices"].get<std::size_t>()]["count"],
              3 * mesh.triangles().size());
    EXPECT_EQ(document["accessors"][triangles["attributes"]["POSITION"].get<std::size_t>()]["count"],
              mesh.vertices().size());
    EXPECT_EQ(document["meshes"][1]["name"], "roadmap");
    const std::size_t root = document["scenes"][0]["nodes"][0];
    EXPECT_EQ(document["nodes"][root]["children"].size(), 2 + mesh.spawn_points().size());
}

TEST(Glb, OfAMapWithoutTrianglesIsValid) {
    const json document = document_of(to_glb(test::make_freespace(test::empty_contents())).value());
    EXPECT_FALSE(document.contains("meshes"));
    EXPECT_FALSE(document.contains("buffers"));
}

TEST(Glb, OfAScenePlacesItsVerticesWithinHalfAStep) {
    scene::Scene scene;
    scene.name = "room";
    scene.metres_per_unit = 0.5;
    scene.vertices = {{-100.0, 7.0, 3.0}, {500.5, 7.0, 3.0}, {33.25, 1234.5, 3.0}, {-1.0, 8.0, 3.0}};
    scene.triangles = {{0, 1, 2}, {2, 1, 3}};
    const Bytes file = to_glb(scene).value();
    const json document = document_of(file);
    const std::size_t binary = 20 + value_at<std::uint32_t>(file, 12) + 8;
    const json& primitive = document["meshes"][0]["primitives"][0];
    const json& node = document["nodes"][0];
    ASSERT_EQ(node["name"], "obstacles");
    for (std::size_t i = 0; i < scene.vertices.size(); ++i)
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double step = node["scale"][axis];
            const double value = value_at<std::uint16_t>(file, binary + 8 * i + 2 * axis) * step +
                                 node["translation"][axis].get<double>();
            EXPECT_NEAR(value, scene.vertices[i][static_cast<Eigen::Index>(axis)], 0.5 * step + 1e-9);
        }
    const json& corners = document["accessors"][primitive["indices"].get<std::size_t>()];
    EXPECT_EQ(corners["count"], 6);
    const std::size_t offset =
        document["bufferViews"][corners["bufferView"].get<std::size_t>()]["byteOffset"];
    EXPECT_EQ(value_at<std::uint32_t>(file, binary + offset + 4 * 5), 3U);
    EXPECT_FALSE(to_glb(scene::Scene())) << "no triangles";
}

}  // namespace
}  // namespace camdir::exports
