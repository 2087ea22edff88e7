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

}  // namespace
}  // namespace camdir::exports
