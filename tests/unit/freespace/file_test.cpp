#include "base/file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <random>
#include <sstream>

#include "freespace/check.hpp"
#include "freespace/freespace.hpp"
#include "support/freespace_meshes.hpp"
#include "support/vfs_seal.hpp"

namespace camdir::freespace {
namespace {

using test::empty_contents;
using test::make_freespace;
using test::random_contents;
using test::square_contents;
using testing::HasSubstr;

std::string error_of(Bytes bytes) {
    const auto freespace = Freespace::parse(std::move(bytes), "some.vfs");
    return freespace ? "" : freespace.error().message;
}

// The corners' x y z r of every triangle, in an order that does not depend on their indices.
using Corner = std::array<float, 4>;
std::vector<std::array<Corner, 3>> shapes(std::span<const Vertex> vertices,
                                          std::span<const Triangle> triangles) {
    const auto corner = [&](std::uint32_t v) {
        return Corner{vertices[v].x, vertices[v].y, vertices[v].z, vertices[v].free_distance};
    };
    std::vector<std::array<Corner, 3>> shapes;
    for (const auto& [a, b, c] : triangles)
        shapes.push_back({corner(a), corner(b), corner(c)});
    std::ranges::sort(shapes);
    return shapes;
}

// Every field of every mover.
std::vector<std::string> described(std::span<const MoverShape> movers) {
    std::vector<std::string> texts;
    for (const MoverShape& mover : movers) {
        std::ostringstream text;
        text << mover.name << '|' << mover.kind << '|' << mover.rest.transpose();
        for (const ConvexHull& hull : mover.hulls) {
            text << " hull " << hull.bounds.min().transpose() << " to " << hull.bounds.max().transpose();
            for (const auto& [normal, distance] : hull.half_spaces)
                text << ", " << normal.transpose() << ": " << distance;
        }
        for (const auto& [centre, radius] : mover.balls)
            text << " ball " << centre.transpose() << ": " << radius;
        texts.push_back(text.str());
    }
    return texts;
}

// The offset of the bytes of `value` in `bytes`.
template <class Value>
std::size_t position_of(const Bytes& bytes, const Value& value) {
    std::array<std::byte, sizeof value> pattern;
    std::memcpy(pattern.data(), &value, sizeof value);
    return static_cast<std::size_t>(std::search(bytes.begin(), bytes.end(), pattern.begin(), pattern.end()) -
                                    bytes.begin());
}

TEST(File, KeepsEverything) {
    std::mt19937 random(1);
    Contents contents = random_contents(random, 20, 15, 30);
    contents.fixed_shots[0].spawn_point = 1;
    const Freespace freespace = make_freespace(contents);
    const Metadata& metadata = freespace.metadata();
    EXPECT_EQ(metadata.map_name, contents.metadata.map_name);
    EXPECT_EQ(metadata.source_name, contents.metadata.source_name);
    EXPECT_EQ(metadata.source_hash, contents.metadata.source_hash);
    EXPECT_EQ(metadata.metres_per_unit, contents.metadata.metres_per_unit);
    EXPECT_EQ(metadata.d0, contents.metadata.d0);
    EXPECT_EQ(metadata.parameters, contents.metadata.parameters);
    ASSERT_EQ(metadata.counts.size(), 2U);
    EXPECT_EQ(metadata.counts[1].stage, "voronoi");
    EXPECT_EQ(metadata.counts[1].what, "vertices");
    EXPECT_EQ(metadata.counts[1].value, 5678.0);
    ASSERT_EQ(freespace.spawn_points().size(), 2U);
    EXPECT_EQ(freespace.spawn_points()[1].eye, Vec3f(-4.0F, 5.0F, -6.0F));
    EXPECT_EQ(freespace.spawn_points()[1].yaw, -1.5F);
    EXPECT_THAT(described(freespace.movers()), testing::ElementsAreArray(described(contents.movers)));
    EXPECT_THAT(freespace.fixed_shots(), testing::ElementsAreArray(contents.fixed_shots));
    EXPECT_EQ(freespace.vertices().size(), contents.vertices.size());
    EXPECT_EQ(shapes(freespace.vertices(), freespace.triangles()),
              shapes(contents.vertices, contents.triangles));
    for (const Vertex& vertex : freespace.vertices())
        EXPECT_TRUE(freespace.bounds().contains(vertex.position()));
}

TEST(File, EqualContentsGiveEqualBytes) {
    std::mt19937 one(5), other(5);
    EXPECT_EQ(encode(random_contents(one, 20, 15, 30)), encode(random_contents(other, 20, 15, 30)));
}

TEST(File, TheLongestReportIsRead) {
    Contents contents = square_contents();
    contents.metadata.counts.resize(9'999, {"stage", "what", 1.0});
    EXPECT_EQ(make_freespace(contents).metadata().counts.size(), 9'999U);
}

TEST(File, HoldsAsManyMoversAsTheLimitsAllow) {
    Contents contents = square_contents();
    const ConvexHull hull{std::vector(max_half_spaces, HalfSpace{Vec3f::UnitX(), 1.0F}),
                          contents.movers[0].hulls[0].bounds};
    contents.movers.assign(max_movers, {"", std::string(64, 'k'), {hull}, {}, Vec3f::Zero()});
    for (std::size_t i = 0; i < max_movers; ++i)
        contents.movers[i].name = "*" + std::to_string(i);
    contents.movers.back().hulls.assign(max_hulls, hull);
    contents.movers.back().balls.assign(max_hulls, {Vec3f::Ones(), 1.0F});
    contents.metadata.counts.resize(9'999, {"stage", "what", 1.0});
    EXPECT_EQ(described(make_freespace(contents).movers()), described(contents.movers));
}

TEST(File, MayHoldNoMovers) {
    Contents contents = square_contents();
    contents.movers.clear();
    EXPECT_TRUE(make_freespace(contents).movers().empty());
}

TEST(File, MoversHaveNoMoreAndNoLessThanTheFile) {
    const Contents contents = empty_contents();
    const Box3f& box = contents.movers[0].hulls[0].bounds;
    const std::array<float, 6> stored = {box.min().x(), box.min().y(), box.min().z(),
                                         box.max().x(), box.max().y(), box.max().z()};
    const Bytes good = encode(contents);
    const auto error_with = [&](std::uint32_t half_spaces) {
        Bytes bytes = good;
        std::memcpy(bytes.data() + position_of(good, stored) + sizeof stored, &half_spaces,
                    sizeof half_spaces);
        test::reseal(bytes);
        return error_of(std::move(bytes));
    };
    EXPECT_EQ(error_with(6), "");
    EXPECT_THAT(error_with(7), HasSubstr("a hull has half spaces that do not exist"));
    EXPECT_THAT(error_with(0xffffffffU), HasSubstr("a hull has half spaces that do not exist"));
    EXPECT_THAT(error_with(5), HasSubstr("there are hulls, half spaces or balls of no mover"));
}

TEST(File, MoversOfDamagedFilesAreValid) {
    const Bytes good = encode(empty_contents());
    std::mt19937 random(6);
    for (std::size_t i = 0; i < good.size(); ++i) {
        Bytes bad = good;
        bad[i] ^= static_cast<std::byte>(1 + random() % 255);
        test::reseal(bad);
        const auto freespace = Freespace::parse(std::move(bad), "some.vfs");
        EXPECT_TRUE(!freespace || find_movers_flaw(freespace->movers()).empty()) << "byte " << i;
    }
}

TEST(File, MayHoldNoMesh) {
    const Freespace freespace = make_freespace(empty_contents());
    EXPECT_TRUE(freespace.vertices().empty());
    EXPECT_TRUE(freespace.triangles().empty());
}

TEST(File, UnusedVerticesStay) {
    Contents contents = square_contents();
    contents.vertices.insert(contents.vertices.begin(), {7, 7, 7, 7});
    for (Triangle& triangle : contents.triangles)
        triangle = {triangle.a + 1, triangle.b + 1, triangle.c + 1};
    const Freespace freespace = make_freespace(contents);
    EXPECT_EQ(freespace.vertices().size(), 5U);
    EXPECT_EQ(freespace.vertices()[4].x, 7.0F);
    EXPECT_TRUE(freespace.incident(4).empty());
}

TEST(File, IsReadFromDiskAndDoesNotChangeWithTheFile) {
    const auto path =
        std::filesystem::temp_directory_path() / ("camdir-" + std::to_string(::getpid()) + ".vfs");
    const Bytes bytes = encode(square_contents());
    ASSERT_TRUE(write_file(path, bytes));
    const auto freespace = Freespace::open(path);
    ASSERT_TRUE(freespace) << freespace.error().message;
    std::filesystem::resize_file(path, 0);
    EXPECT_EQ(freespace->byte_size(), bytes.size());
    ASSERT_EQ(freespace->triangles().size(), 2U);
    EXPECT_EQ(freespace->vertices()[freespace->triangles()[0].a].free_distance, 40.0F);
    EXPECT_THAT(Freespace::open(path).error().message, HasSubstr(path.string() + ": is not a baked map"));
    std::filesystem::remove(path);
    EXPECT_THAT(Freespace::open(path).error().message, HasSubstr(path.string() + ": cannot open"));
}

TEST(File, EveryFlippedByteIsRefused) {
    const Bytes good = encode(square_contents());
    std::mt19937 random(4);
    for (std::size_t i = 0; i < good.size(); ++i) {
        Bytes bad = good;
        bad[i] ^= static_cast<std::byte>(1 + random() % 255);
        EXPECT_THAT(error_of(bad), testing::StartsWith("some.vfs: ")) << "byte " << i;
    }
}

TEST(File, EveryTruncationIsRefused) {
    const Bytes good = encode(square_contents());
    for (std::size_t size = 0; size < good.size(); ++size)
        EXPECT_NE(error_of(Bytes(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(size))), "")
            << size;
    Bytes cut(good.begin(), good.end() - 40);
    EXPECT_THAT(error_of(cut), HasSubstr("is truncated"));
    Bytes longer = good;
    longer.resize(good.size() + 8);
    EXPECT_NE(error_of(longer), "");
}

TEST(File, ErrorsSayWhatIsWrong) {
    EXPECT_THAT(error_of({}), HasSubstr("is not a baked map"));
    EXPECT_THAT(error_of(Bytes(1'000, std::byte{'x'})), HasSubstr("is not a baked map"));
    const Bytes good = encode(square_contents());
    Bytes newer = good;
    newer[position_of(good, std::uint64_t{good.size()}) - 8] = std::byte{5};
    EXPECT_THAT(error_of(newer), HasSubstr("was written by a newer version: format 5, this program reads 4"));
    Bytes older = good;
    older[position_of(good, std::uint64_t{good.size()}) - 8] = std::byte{3};
    EXPECT_THAT(error_of(older), HasSubstr("was written by an older version: format 3, this program reads 4; "
                                           "bake the map again"));
    Bytes damaged = good;
    damaged.back() ^= std::byte{1};
    EXPECT_THAT(error_of(damaged), HasSubstr("is damaged"));
}

TEST(FileDeathTest, ContentsThatBreakTheirPromisesAreABug) {
    Contents out_of_range = square_contents();
    out_of_range.triangles.push_back({0, 1, 4});
    EXPECT_DEATH(static_cast<void>(encode(out_of_range)), "find_mesh_flaw");
    Contents without_d0 = square_contents();
    without_d0.metadata.d0 = 0.0F;
    EXPECT_DEATH(static_cast<void>(encode(without_d0)), "find_metadata_flaw");
    Contents not_finite = square_contents();
    not_finite.vertices[0].free_distance = NAN;
    EXPECT_DEATH(static_cast<void>(encode(not_finite)), "find_mesh_flaw");
    Contents namesakes = square_contents();
    namesakes.movers[1].name = namesakes.movers[0].name;
    EXPECT_DEATH(static_cast<void>(encode(namesakes)), "find_movers_flaw");
}

// What the fuzzer of MAP.vfs begins with: of an older format it would not come past the header.
std::vector<std::pair<std::string, Bytes>> seeds() {
    std::mt19937 random(1);
    Contents no_movers = square_contents();
    no_movers.movers.clear();
    const Bytes square = encode(square_contents());
    Bytes damaged = square;
    damaged[damaged.size() / 2] ^= std::byte{1};
    return {
        {"square", square},
        {"no_movers", encode(no_movers)},
        {"no_mesh", encode(empty_contents())},
        {"loose_triangles", encode(random_contents(random, 3, 3, 20))},
        {"damaged", damaged},
        {"cut_off", Bytes(square.begin(), square.begin() + static_cast<std::ptrdiff_t>(square.size() / 2))}};
}

TEST(File, TheFuzzersSeedsAreOfThisFormat) {
    for (const auto& [name, bytes] : seeds()) {
        const std::string file = std::string(CAMDIR_VFS_SEEDS) + "/" + name + ".vfs";
        if (std::getenv("CAMDIR_WRITE_SEEDS") != nullptr) {
            ASSERT_TRUE(write_file(file, bytes));
        }
        EXPECT_EQ(read_file(file).value(), bytes) << file << ": run this test with CAMDIR_WRITE_SEEDS=1";
    }
    for (const char* name : {"square", "no_movers", "loose_triangles"})
        EXPECT_TRUE(Freespace::open(std::string(CAMDIR_VFS_SEEDS) + "/" + name + ".vfs")) << name;
}

}  // namespace
}  // namespace camdir::freespace
