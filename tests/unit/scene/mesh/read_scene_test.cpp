// Meshes: every format gives the same triangles, each where its node puts it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "scene/load.hpp"
#include "support/clouds.hpp"
#include "support/temporary_folder.hpp"

namespace camdir::scene {
namespace {

using testing::HasSubstr;
using testing::UnorderedElementsAre;

class Mesh : public testing::Test {
  protected:
    std::string write(const std::string& name, const std::string& bytes) {
        const auto path = folder_ / name;
        std::ofstream(path, std::ios::binary) << bytes;
        return path.string();
    }
    std::string refusal(const std::string& path, const ReadOptions& options = {}) {
        const auto scene = load(path, options);
        return scene ? "nothing refused" : scene.error().message;
    }

    test::TemporaryFolder folder_;
};

// A right triangle at z = 2: (0,0), (4,0), (0,1).
const std::string obj = "mtllib absent.mtl\nv 0 0 2\nv 4 0 2\nv 0 1 2\nv 0 0 2\nf 1 2 3\nf 1 1 2\n";
const std::string ply =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 2\n4 0 2\n0 1 2\n3 0 1 2\n";
const std::string ascii_stl =
    "solid made\nfacet normal 0 0 1\nouter loop\nvertex 0 0 2\nvertex 4 0 2\nvertex 0 1 "
    "2\nendloop\nendfacet\n"
    "endsolid made\n";

std::string binary_stl() {
    std::string bytes(80, '\0');
    test::append(bytes, std::uint32_t{1});
    for (const float number : {0.F, 0.F, 1.F, 0.F, 0.F, 2.F, 4.F, 0.F, 2.F, 0.F, 1.F, 2.F})
        test::append(bytes, number);
    test::append(bytes, std::uint16_t{0});
    return bytes;
}

// y up, the node moves by (0, 10, 0): corners (0,10,2), (4,10,2), (0,11,2) in its own axes.
std::string gltf(const std::string& uri) {
    return R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0, "translation": [0, 10, 0]}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                       "min": [0, 0, 2], "max": [4, 1, 2]}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "buffers": [{"byteLength": 36, "uri": ")" +
           uri + "\"}]}";
}

std::string corners() {
    std::string bytes;
    for (const float number : {0.F, 0.F, 2.F, 4.F, 0.F, 2.F, 0.F, 1.F, 2.F})
        test::append(bytes, number);
    return bytes;
}

TEST_F(Mesh, EveryFormatGivesTheSameTriangle) {
    for (const std::string& path :
         {write("a.obj", obj), write("b.ply", ply), write("c.stl", ascii_stl), write("d.stl", binary_stl()),
          write("e", obj), write("f.dat", binary_stl())}) {
        const Scene scene = load(path).value();
        ASSERT_EQ(scene.triangles.size(), 1U) << path;
        EXPECT_THAT(scene.vertices, UnorderedElementsAre(Vec3d(0, 0, 2), Vec3d(4, 0, 2), Vec3d(0, 1, 2)));
        EXPECT_TRUE(scene.points.empty());
        EXPECT_EQ(scene.metres_per_unit, 1.0);
        EXPECT_TRUE(scene.spawn_points.empty());
    }
}

TEST_F(Mesh, GltfIsTurnedAndItsNodesArePlaced) {
    write("the corners.bin", corners());
    const Scene scene = load(write("a.gltf", gltf("the%20corners.bin"))).value();
    EXPECT_THAT(scene.vertices, UnorderedElementsAre(Vec3d(2, 0, 10), Vec3d(2, 4, 10), Vec3d(2, 0, 11)));
    ReadOptions unturned;
    unturned.up = UpAxis::z;
    const Scene other = load((folder_ / "a.gltf").string(), unturned).value();
    EXPECT_THAT(other.vertices, UnorderedElementsAre(Vec3d(0, 10, 2), Vec3d(4, 10, 2), Vec3d(0, 11, 2)));
}

TEST_F(Mesh, HashCoversTheBuffersOfAGltf) {
    const std::string path = write("a.gltf", gltf("a.bin"));
    write("a.bin", corners());
    const std::uint64_t before = hash_source(path).value();
    EXPECT_EQ(load(path).value().source_hash, before);
    write("a.bin", corners() + "more");
    EXPECT_NE(hash_source(path).value(), before);
}

TEST_F(Mesh, RefusesGltfWithoutItsBuffer) {
    EXPECT_THAT(refusal(write("a.gltf", gltf("absent.bin"))), HasSubstr("absent.bin"));
    write("short.bin", "123");
    EXPECT_THAT(refusal(write("b.gltf", gltf("short.bin"))), HasSubstr("ends after 3 bytes"));
    EXPECT_THAT(refusal(write("c.gltf", gltf("../a.bin"))), HasSubstr("/buffers/0/uri"));
    EXPECT_THAT(refusal(write("d.gltf", gltf("/etc/hostname"))), HasSubstr("/buffers/0/uri"));
    EXPECT_THAT(refusal(write("e.gltf", std::string(100000, '['))), HasSubstr("nested deeper"));
    EXPECT_THAT(refusal(write("f.gltf", "{\"a\":" + std::string(100000, '['))), HasSubstr("nested deeper"));
}

TEST_F(Mesh, RefusesOtherContent) {
    EXPECT_THAT(refusal(write("a.obj", "v 0 0 0\nv 1 0 0\n")), HasSubstr("a.obj"));
    EXPECT_THAT(refusal(write("b.obj", "v 0 0 0\nv 1 0 0\nv nan 1 0\nf 1 2 3\n")), HasSubstr("b.obj"));
    EXPECT_THAT(refusal(write("c.stl", binary_stl().substr(0, 100))), HasSubstr("c.stl"));
    EXPECT_THAT(refusal(write("d.txt", "good evening\n")), HasSubstr("unknown format"));
    EXPECT_THAT(refusal(write("e.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n")),
                HasSubstr("no triangle with an area"));
}

TEST_F(Mesh, SeedsJoinTheSpawnPoints) {
    ReadOptions options;
    options.seeds = {{1.0, 0.5, 2.0}};
    const Scene scene = load(write("a.obj", obj), options).value();
    ASSERT_EQ(scene.spawn_points.size(), 1U);
    EXPECT_EQ(scene.spawn_points[0].eye, options.seeds[0]);
    EXPECT_EQ(scene.options, options);
    options.seeds = {{1.0, 0.5, 20.0}};
    EXPECT_THAT(refusal(write("a.obj", obj), options), HasSubstr("outside the map's box"));
}

// A triangle at UTM coordinates, where single precision has steps of 0.03 and 0.5.
const Vec3d utm(448262.0, 5412345.0, 300.0);
const std::vector<Vec3d> utm_corners = {utm + Vec3d(0.234, 0.678, 0.001), utm + Vec3d(4.5, 0.678, 0.001),
                                        utm + Vec3d(0.234, 1.123, 0.00002)};

std::string utm_obj() {
    return "v " + test::xyz_of({utm_corners[0]}) + "v\t" + test::xyz_of({utm_corners[1]}) + "v  " +
           test::xyz_of({utm_corners[2]}) + "vn 0 0 1\nf 1 2 3\n";
}

std::string utm_ply(const std::string& format, const std::string& type) {
    std::string bytes = "ply\nformat " + format + " 1.0\nelement vertex 3\nproperty uchar red\n";
    for (const char* axis : {"x", "y", "z"})
        bytes += "property " + type + ' ' + axis + '\n';
    bytes += "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
    if (format == "ascii") {
        for (const Vec3d& corner : utm_corners)
            bytes += "200 " + test::xyz_of({corner});
        return bytes + "3 0 1 2\n";
    }
    const auto append = [&](auto value) {
        std::string number;
        test::append(number, value);
        if (format == "binary_big_endian") std::reverse(number.begin(), number.end());
        bytes += number;
    };
    for (const Vec3d& corner : utm_corners) {
        append(std::uint8_t{200});
        for (const double coordinate : corner)
            type == "double" ? append(coordinate) : append(static_cast<float>(coordinate));
    }
    append(std::uint8_t{3});
    for (const std::int32_t index : {0, 1, 2})
        append(index);
    return bytes;
}

TEST_F(Mesh, OriginIsSubtractedInDoublePrecision) {
    ReadOptions options;
    options.origin = utm;
    for (const std::string& path : {write("a.obj", utm_obj()), write("b.ply", utm_ply("ascii", "double")),
                                    write("c.ply", utm_ply("ascii", "float")),
                                    write("d.ply", utm_ply("binary_little_endian", "double")),
                                    write("e.ply", utm_ply("binary_big_endian", "double"))}) {
        SCOPED_TRACE(path);
        const auto scene = load(path, options);
        ASSERT_TRUE(scene.has_value()) << scene.error().message;
        ASSERT_EQ(scene->vertices.size(), 3U);
        for (std::size_t i = 0; i < 3; ++i)
            EXPECT_LT((scene->vertices[i] - (utm_corners[i] - utm)).norm(), 2e-6);
    }
}

TEST_F(Mesh, OriginRefusesWhatSinglePrecisionHasLost) {
    ReadOptions options;
    options.origin = utm;
    const std::string stl = "solid made\nfacet normal 0 0 1\nouter loop\nvertex " +
                            test::xyz_of({utm_corners[0]}) + "vertex " + test::xyz_of({utm_corners[1]}) +
                            "vertex " + test::xyz_of({utm_corners[2]}) + "endloop\nendfacet\nendsolid made\n";
    for (const std::string& path :
         {write("a.stl", stl), write("b.ply", utm_ply("binary_little_endian", "float"))})
        EXPECT_THAT(refusal(path, options),
                    AllOf(HasSubstr("single precision, in steps of 0.5 map units"), HasSubstr("write OBJ")));
    options.origin = Vec3d(1.0, 0.0, 0.0);
    EXPECT_EQ(load(write("c.stl", ascii_stl), options).value().vertices[0].z(), 2.0) << "near enough";
}

TEST_F(Mesh, OriginNamesTheLineOfABrokenPosition) {
    ReadOptions options;
    options.origin = utm;
    EXPECT_THAT(refusal(write("a.obj", "v 0 0 0\nv 1 0\nf 1 2 1\n"), options), HasSubstr("line 2"));
    EXPECT_THAT(refusal(write("b.obj", "v 0 0 0\nv 1 0 x\nf 1 2 1\n"), options), HasSubstr("line 2: 'x'"));
    const std::string cut = utm_ply("ascii", "float");
    EXPECT_THAT(refusal(write("c.ply", cut.substr(0, cut.find("end_header") + 20)), options),
                HasSubstr("expected at least 4"));
}

TEST_F(Mesh, WeightedObjPositionsAreDividedByTheirWeight) {
    ReadOptions options;
    options.origin = Vec3d(10.0, 0.0, 0.0);
    const Scene scene =
        load(write("a.obj", "v 22 0 4 2\nv 30 0 4 2\nv 22 2 4 2\nf 1 2 3\n"), options).value();
    EXPECT_THAT(scene.vertices, UnorderedElementsAre(Vec3d(1, 0, 2), Vec3d(5, 0, 2), Vec3d(1, 1, 2)));
}

TEST_F(Mesh, CountsWhatItSkips) {
    const Scene scene = load(write("a.obj", obj)).value();
    ASSERT_EQ(scene.skipped.size(), 1U);
    EXPECT_EQ(scene.skipped[0].count, 1U);
}

TEST_F(Mesh, OriginReadsTheLinesThatAssimpReads) {
    ReadOptions options;
    options.origin = Vec3d(10.0, 0.0, 0.0);
    const std::string faces = "f 1 2 3\n";
    const std::string carriage_returns = "v 11 0 2\rv 15 0 2\rv 11 1 2\rf 1 2 3\r";
    const std::string trailing = "v 11 0 2 1 0.5 0 # red\nv\t15\t0\t2\r\nv  +1.1e1  1 2 \t\n" + faces;
    for (const std::string& text : {carriage_returns, trailing}) {
        SCOPED_TRACE(text);
        const auto scene = load(write("a.obj", text), options);
        ASSERT_TRUE(scene.has_value()) << scene.error().message;
        EXPECT_THAT(scene->vertices, UnorderedElementsAre(Vec3d(1, 0, 2), Vec3d(5, 0, 2), Vec3d(1, 1, 2)));
    }
    const std::string decimal_commas = "v 11,0 0,0 2,0\nv 15,0 0,0 2,0\nv 11,0 1,0 2,0\n" + faces;
    EXPECT_THAT(refusal(write("b.obj", decimal_commas), options), HasSubstr("line 1: '11,0'"));
    EXPECT_THAT(refusal(write("c.obj", "v 11 0 2\n v 15 0 2\nv 15 0 2\nv 11 1 2\n v\nf 1 2 4\n"), options),
                HasSubstr("out of range"))
        << "for Assimp an indented line is no position";
}

// Corners of ply, with a face of five.
std::string five_cornered(const std::string& last_index) {
    return "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\n"
           "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
           "0 0 0\n2 0 0\n2 1 0\n1 2 0\n0 1 0\n5 0 1 2 3 " +
           last_index + "\n";
}

TEST_F(Mesh, PlyIndicesThatDoNotExistAreRefused) {
    EXPECT_EQ(load(write("a.ply", five_cornered("4"))).value().triangles.size(), 3U);
    for (const std::string index : {"99999999", "5", "-5", "1e300", "nan"})
        EXPECT_THAT(refusal(write("b.ply", five_cornered(index))),
                    HasSubstr("face 0: expected indices of 5 vertices"))
            << index;
}

TEST_F(Mesh, EveryTruncatedPlyIsRefused) {
    for (const std::string format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
        const std::string whole = utm_ply(format, "double");
        const std::size_t least = format == "ascii" ? 3 : 1;  // without the last index
        for (std::size_t size = 4; size + least <= whole.size(); size += size < 200 ? 7 : 1)
            EXPECT_NE(refusal(write("cut.ply", whole.substr(0, size))), "nothing refused") << format << size;
    }
}

TEST_F(Mesh, PlyElementsMayStandInAnyNumberAndOrder) {
    const std::string corners = "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
    const std::string faces = "property list uchar int vertex_indices\n";
    const std::string head = "ply\nformat ascii 1.0\n";
    const std::string rows = "0 0 2\n\n4 0 2\n0 1 2\n";
    const std::vector<std::string> same = {
        head + "element camera 1\nproperty list uchar int q\n" + corners + "element face 1\n" + faces +
            "end_header\n2 7 7\n" + rows + "3 0 1 2\n",
        head + corners + "element camera 1\nproperty int q\nelement face 1\nproperty int flags\n" + faces +
            "end_header\n" + rows + "7\n1 3 0 1 2\n",
        head + corners + "element face 1\n" + faces + "element face 2\n" + faces + "end_header\n" + rows +
            "3 0 1 2\n3 0 1 2\n3 0 2 1\n",
        head + corners + "element tristrips 1\n" + faces + "end_header\n" + rows + "7 0 1 2 -1 2 1 0\n"};
    const Scene expected = load(write("a.ply", ply)).value();
    for (const std::string& text : same) {
        SCOPED_TRACE(text);
        const auto scene = load(write("b.ply", text));
        ASSERT_TRUE(scene.has_value()) << scene.error().message;
        EXPECT_EQ(scene->vertices, expected.vertices);
        EXPECT_EQ(scene->triangles.size(), 1U);
    }
}

}  // namespace
}  // namespace camdir::scene
