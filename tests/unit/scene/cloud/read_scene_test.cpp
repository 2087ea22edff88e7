// Point clouds: every format and encoding gives the same points; other content is refused with a reason.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <liblzf/lzf.h>

#include <algorithm>
#include <string>

#include "scene/cloud/read_scene.hpp"
#include "scene/load.hpp"
#include "support/clouds.hpp"
#include "support/shared_files.hpp"

namespace camdir::scene {
namespace {

using testing::HasSubstr;

// Exact as floats and as thousandths; ascending, as in a scene.
const std::vector<Vec3d> points = {{-1.5, 2.0, 0.25}, {0.0, 0.0, 0.0},   {0.0, 0.5, 0.0},
                                   {0.5, 0.0, 0.0},   {0.5, 0.5, -0.25}, {1.0, 0.75, 8.0}};

Scene read(const std::string& bytes, CloudFormat format, const ReadOptions& options = {}) {
    return read_cloud_scene(test::bytes_of(bytes), format, options).value();
}

std::string refusal(const std::string& bytes, CloudFormat format, const ReadOptions& options = {}) {
    const auto scene = read_cloud_scene(test::bytes_of(bytes), format, options);
    return scene ? "nothing refused" : scene.error().message;
}

std::string ascii_pcd() {
    std::string text = test::pcd_header(points.size(), "ascii");
    for (const Vec3d& p : points)
        text += "7 " + test::xyz_of({p});
    return text;
}

std::string binary_pcd() {
    std::string bytes = test::pcd_header(points.size(), "binary");
    for (const Vec3d& p : points) {
        test::append(bytes, std::uint8_t{7});
        for (const double coordinate : p)
            test::append(bytes, static_cast<float>(coordinate));
    }
    return bytes;
}

std::string compressed_pcd() {
    std::string fields(points.size(), '\7');
    for (Eigen::Index axis = 0; axis < 3; ++axis)
        for (const Vec3d& p : points)
            test::append(fields, static_cast<float>(p[axis]));
    std::string packed(2 * fields.size() + 64, '\0');
    packed.resize(::lzf_compress(fields.data(), static_cast<unsigned>(fields.size()), packed.data(),
                                 static_cast<unsigned>(packed.size())));
    std::string bytes = test::pcd_header(points.size(), "binary_compressed");
    test::append(bytes, static_cast<std::uint32_t>(packed.size()));
    test::append(bytes, static_cast<std::uint32_t>(fields.size()));
    return bytes + packed;
}

std::string ply_header(const std::string& format) {
    return "ply\nformat " + format +
           " 1.0\ncomment made\nelement camera 1\nproperty float focal\nelement vertex " +
           std::to_string(points.size()) +
           "\nproperty uchar red\nproperty double x\nproperty double y\nproperty double z\nend_header\n";
}

std::string ascii_ply() {
    std::string text = ply_header("ascii") + "35.0\n";
    for (const Vec3d& p : points)
        text += "200 " + test::xyz_of({p});
    return text;
}

std::string binary_ply(bool big_endian) {
    std::string bytes = ply_header(big_endian ? "binary_big_endian" : "binary_little_endian");
    test::append(bytes, 35.0F);
    for (const Vec3d& p : points) {
        bytes += '\xc8';
        for (const double coordinate : p) {
            std::string number;
            test::append(number, coordinate);
            if (big_endian) std::reverse(number.begin(), number.end());
            bytes += number;
        }
    }
    return bytes;
}

TEST(Cloud, EveryEncodingGivesTheSamePoints) {
    const Vec3d far(100.0, -20.0, 3.0);
    for (const Scene& scene :
         {read(ascii_pcd(), CloudFormat::pcd), read(binary_pcd(), CloudFormat::pcd),
          read(compressed_pcd(), CloudFormat::pcd), read(ascii_ply(), CloudFormat::ply),
          read(binary_ply(false), CloudFormat::ply), read(binary_ply(true), CloudFormat::ply),
          read("# made\n" + test::xyz_of(points), CloudFormat::xyz)}) {
        EXPECT_EQ(scene.points, points) << scene.kind;
        EXPECT_TRUE(scene.skipped.empty());
        EXPECT_EQ(scene.metres_per_unit, 1.0);
        EXPECT_EQ(scene.bounds.max().z(), 8.0);
    }
    const Scene las = read(test::las_of(points, far), CloudFormat::las);
    ASSERT_EQ(las.points.size(), points.size());
    for (std::size_t i = 0; i < points.size(); ++i)
        EXPECT_LT((las.points[i] - points[i]).norm(), 1e-9);
}

TEST(Cloud, UnitAxisAndOriginAreApplied) {
    ReadOptions options;
    options.metres_per_unit = 0.01;
    options.up = UpAxis::y;
    options.origin = {0.5, 0.5, -0.25};
    const Scene scene = read(test::xyz_of(points), CloudFormat::xyz, options);
    EXPECT_EQ(scene.metres_per_unit, 0.01);
    EXPECT_THAT(scene.points, testing::Contains(Vec3d::Zero().eval()));
    EXPECT_THAT(scene.points, testing::Contains(Vec3d(8.25, 0.5, 0.25)));  // was (1, 0.75, 8)
}

// UTM: single precision has steps of 0.03 and 0.5 there.
TEST(Cloud, OriginIsSubtractedInDoublePrecision) {
    const Vec3d utm(448262.0, 5412345.0, 300.0);
    std::vector<Vec3d> far = points;
    for (Vec3d& point : far)
        point += utm + Vec3d(0.001, 0.002, 0.003);
    std::string pcd = "VERSION 0.7\nFIELDS x y z\nSIZE 8 8 8\nTYPE F F F\nCOUNT 1 1 1\nPOINTS 6\nDATA ";
    std::string binary = pcd + "binary\n";
    std::string ply =
        "ply\nformat binary_little_endian 1.0\nelement vertex 6\nproperty double x\nproperty double "
        "y\nproperty double z\nend_header\n";
    for (const Vec3d& point : far)
        for (const double coordinate : point) {
            test::append(binary, coordinate);
            test::append(ply, coordinate);
        }
    ReadOptions options;
    options.origin = utm + Vec3d(0.001, 0.002, 0.003);
    for (const Scene& scene : {read(test::xyz_of(far), CloudFormat::xyz, options),
                               read(pcd + "ascii\n" + test::xyz_of(far), CloudFormat::pcd, options),
                               read(binary, CloudFormat::pcd, options), read(ply, CloudFormat::ply, options),
                               read(test::las_of(far, utm), CloudFormat::las, options)}) {
        ASSERT_EQ(scene.points.size(), points.size()) << scene.kind;
        for (std::size_t i = 0; i < points.size(); ++i)
            EXPECT_LT((scene.points[i] - points[i]).norm(), 1e-6) << scene.kind;
    }
}

TEST(Cloud, SkipsRepeatedMissingAndStrayPoints) {
    std::vector<Vec3d> walls = test::walls_of(Box3d(Vec3d::Zero(), Vec3d(4.0, 4.0, 2.0)), 0.25);
    const std::size_t count = walls.size();
    const std::string nan = "nan nan nan\n";
    walls.push_back(walls[7]);
    walls.emplace_back(40.0, 2.0, 1.0);
    walls.emplace_back(2.0, -30.0, 1.0);
    std::string text = "VERSION 0.7\nFIELDS x y z\nWIDTH " + std::to_string(walls.size() + 1) +
                       "\nDATA ascii\n" + nan + test::xyz_of(walls);
    const Scene scene = read(text, CloudFormat::pcd);
    EXPECT_EQ(scene.points.size(), count);
    ASSERT_EQ(scene.skipped.size(), 3U);
    EXPECT_EQ(scene.skipped[0].count, 1U);
    EXPECT_EQ(scene.skipped[1].count, 1U);
    EXPECT_EQ(scene.skipped[2].count, 2U);
    EXPECT_GT(scene.point_spacing, 0.25);
    EXPECT_LT(scene.point_spacing, 0.4);
}

TEST(Cloud, RefusesDamagedAndForeignContent) {
    EXPECT_THAT(refusal("1 2 3\n", CloudFormat::xyz), HasSubstr("1 different points"));
    std::string near;  // their squared distances are 0
    for (int i = 0; i < 20; ++i)
        near += std::to_string(i) + "e-200 0 0\n";
    EXPECT_THAT(refusal(near, CloudFormat::xyz), HasSubstr("round to 0"));
    EXPECT_THAT(refusal("1 2 3\n4 5\n", CloudFormat::xyz), HasSubstr("line 2"));
    EXPECT_THAT(refusal("1 2 3\n4 5 x\n", CloudFormat::xyz), HasSubstr("line 2: 'x'"));
    EXPECT_THAT(refusal(test::xyz_of(points) + "nan 1 2\n", CloudFormat::xyz), HasSubstr("point 6 at (nan"));
    EXPECT_THAT(refusal(test::xyz_of(points) + "1e9 1 2\n", CloudFormat::xyz), HasSubstr("--origin"));
    EXPECT_THAT(refusal(ascii_pcd().substr(0, ascii_pcd().size() - 30), CloudFormat::pcd),
                HasSubstr("the header promises 6"));
    EXPECT_THAT(refusal(binary_pcd().substr(0, binary_pcd().size() - 1), CloudFormat::pcd),
                HasSubstr("expected 78"));
    EXPECT_THAT(refusal(compressed_pcd().substr(0, compressed_pcd().size() - 1), CloudFormat::pcd),
                HasSubstr("compressed data"));
    EXPECT_THAT(refusal(binary_ply(false).substr(0, 280), CloudFormat::ply), HasSubstr("expected 6 rows"));
    EXPECT_THAT(refusal(test::pcd_header(20'000'001, "binary"), CloudFormat::pcd),
                HasSubstr("the limit is 20000000"));
    std::string many_fields = "VERSION 0.7\n";
    for (int line = 0; line < 129; ++line)
        many_fields += "FIELDS a b\n";
    EXPECT_THAT(refusal(many_fields, CloudFormat::pcd), HasSubstr("line 130: more than 256 fields"));
    ReadOptions micrometres;
    micrometres.metres_per_unit = 1e-6;
    EXPECT_THAT(refusal(test::xyz_of({{0, 0, 0}, {6e7, 0, 0}}), CloudFormat::xyz, micrometres),
                HasSubstr("below 5e+07 map units"));
    std::string laz = test::las_of(points, Vec3d::Zero());
    laz[104] = static_cast<char>(0x80);
    EXPECT_THAT(refusal(laz, CloudFormat::las), HasSubstr("LAZ"));
    EXPECT_THAT(refusal(test::las_of(points, Vec3d::Zero()).substr(0, 300), CloudFormat::las),
                HasSubstr("6 records of 20"));
}

TEST(Cloud, RefusesCompressedDataThatPromisesTooMuch) {
    std::string bytes =
        "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nPOINTS 20000000\n"
        "DATA binary_compressed\n";
    test::append(bytes, std::uint32_t{8});
    test::append(bytes, std::uint32_t{240'000'000});
    EXPECT_THAT(refusal(bytes + "12345678", CloudFormat::pcd), HasSubstr("cannot hold"));
}

class Scan : public testing::TestWithParam<std::pair<const char*, std::size_t>> {};

TEST_P(Scan, IsReadWhole) {
    const std::string name = std::string("maps/") + GetParam().first;
    const auto file = test::shared_file(name);
    if (!file) GTEST_SKIP() << test::needs_shared_file(name);
    const Scene scene = load(file->string()).value();
    std::size_t count = scene.points.size();
    for (const Skipped& skipped : scene.skipped)
        count += skipped.count;
    EXPECT_EQ(count, GetParam().second);
    for (const Skipped& skipped : scene.skipped) {
        EXPECT_LT(skipped.reason == "outliers" ? skipped.count : 0U, count / 1000);
    }
    EXPECT_GT(scene.points.size(), count * 45 / 100) << "one of them has every second point twice";
    EXPECT_LT(scene.bounds.sizes().maxCoeff(), 30.0);
}

INSTANTIATE_TEST_SUITE_P(Real, Scan,
                         testing::Values(std::pair("room_scan1.pcd", 112586),
                                         std::pair("scan_430.ply", 52586)));

}  // namespace
}  // namespace camdir::scene
