#include "freespace/check.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/freespace_meshes.hpp"

namespace camdir::freespace {
namespace {

// A valid mesh in memory of its own, to be broken.
struct Mesh {
    std::vector<Vertex> vertices;
    std::vector<Triangle> triangles;
    HintView hints;
    std::vector<std::uint32_t> hint_triangles;

    Mesh() {
        std::mt19937 random(9);
        const Freespace freespace = test::make_freespace(test::random_contents(random, 12, 9, 0));
        vertices.assign(freespace.vertices().begin(), freespace.vertices().end());
        triangles.assign(freespace.triangles().begin(), freespace.triangles().end());
        const Hints made =
            build_hints({vertices, triangles}, build_index(vertices, triangles), freespace.bounds());
        hints = {made.cell_size, made.extent, {}};
        hint_triangles = made.triangles;
    }
    [[nodiscard]] std::string flaw() const {
        HintView grid = hints;
        grid.triangles = hint_triangles;
        const std::string flaw = find_mesh_flaw(vertices, triangles);
        return flaw.empty() ? find_hints_flaw(grid, triangles.size()) : flaw;
    }
};

class CheckTest : public testing::Test {
  protected:
    void SetUp() override { ASSERT_EQ(mesh.flaw(), ""); }
    Mesh mesh;
};

TEST_F(CheckTest, Bounds) {
    const std::vector<Vertex> vertices{{0.0F, 0.0F, 0.0F, 1.0F}, {2.0F, 1.0F, -1.0F, 1.0F}};
    const Box3f bounds(Vec3f(0.0F, 0.0F, -1.0F), Vec3f(2.0F, 1.0F, 0.0F));
    EXPECT_EQ(find_bounds_flaw(bounds, vertices), "");
    EXPECT_EQ(find_bounds_flaw({bounds.min(), Vec3f(1.0F, 1.0F, 0.0F)}, vertices),
              "vertex 1 lies outside the bounds");
    EXPECT_EQ(find_bounds_flaw({bounds.max(), bounds.min()}, vertices), "vertex 0 lies outside the bounds");
    for (const float bad : {NAN, INFINITY, 3e38F}) {
        EXPECT_EQ(find_bounds_flaw({bounds.min(), Vec3f::Constant(bad)}, vertices),
                  "the bounds are not finite or out of range");
        EXPECT_EQ(find_bounds_flaw({Vec3f::Constant(-bad), bounds.max()}, {}),
                  "the bounds are not finite or out of range");
    }
}

TEST_F(CheckTest, Metadata) {
    const Contents good = test::empty_contents();
    EXPECT_EQ(find_metadata_flaw(good.metadata, good.spawn_points), "");
    for (const float bad : {0.0F, -1.0F, NAN, INFINITY}) {
        Metadata broken = good.metadata;
        broken.metres_per_unit = bad;
        EXPECT_EQ(find_metadata_flaw(broken, {}), "metres_per_unit is not a positive number");
        broken = good.metadata;
        broken.d0 = bad;
        EXPECT_EQ(find_metadata_flaw(broken, {}), "d0 is not a positive number");
    }
    Metadata coarse = good.metadata;
    coarse.d0 = coordinate_limit;
    EXPECT_EQ(find_metadata_flaw(coarse, {}), "");
    coarse.d0 = std::nextafter(coordinate_limit, INFINITY);
    EXPECT_EQ(find_metadata_flaw(coarse, {}), "d0 is out of range");
    Metadata long_report = good.metadata;
    long_report.counts.resize(count_limit);
    EXPECT_EQ(find_metadata_flaw(long_report, {}), "the report has too many counts");
    std::vector<SpawnPoint> spawn_points = good.spawn_points;
    spawn_points[1].yaw = NAN;
    EXPECT_EQ(find_metadata_flaw(good.metadata, spawn_points), "spawn point 1 is not finite");
}

TEST_F(CheckTest, Movers) {
    const std::vector<MoverShape> good = test::empty_contents().movers;
    EXPECT_EQ(find_movers_flaw(good), "");
    const auto flaw = [&](auto damage) {
        std::vector<MoverShape> movers = good;
        damage(movers[1], movers[0].hulls[1]);
        return find_movers_flaw(movers);
    };
    const std::string of_name = "mover 1 has no name, or a name or a kind that is too long";
    EXPECT_EQ(flaw([](MoverShape& mover, ConvexHull&) { mover.name = ""; }), of_name);
    EXPECT_EQ(flaw([](MoverShape& mover, ConvexHull&) { mover.name.assign(65, 'n'); }), of_name);
    EXPECT_EQ(flaw([](MoverShape& mover, ConvexHull&) { mover.kind.assign(65, 'n'); }), of_name);
    EXPECT_EQ(flaw([](MoverShape& mover, ConvexHull&) { mover.name = "*1"; }),
              "mover 1 has the name of another");
    EXPECT_EQ(flaw([](MoverShape& mover, ConvexHull&) { mover.balls.clear(); }),
              "mover 1 has no hull and no ball");
    EXPECT_EQ(flaw([](MoverShape& mover, ConvexHull&) { mover.balls.resize(257, mover.balls[0]); }),
              "mover 1 has too many hulls or balls");
    EXPECT_EQ(flaw([](MoverShape& mover, ConvexHull& hull) { mover.hulls.resize(257, hull); }),
              "mover 1 has too many hulls or balls");
    for (const float bad : {NAN, INFINITY, 2.0F * coordinate_limit}) {
        EXPECT_EQ(flaw([&](MoverShape& mover, ConvexHull&) { mover.rest.y() = bad; }),
                  "mover 1 rests at a position that is not finite or out of range");
        EXPECT_EQ(flaw([&](MoverShape& mover, ConvexHull&) { mover.balls[0].radius = bad; }),
                  "mover 1 has a ball that is not finite, out of range or without a radius");
        EXPECT_EQ(flaw([&](MoverShape& mover, ConvexHull&) { mover.balls[0].centre.z() = bad; }),
                  "mover 1 has a ball that is not finite, out of range or without a radius");
        EXPECT_EQ(flaw([&](MoverShape&, ConvexHull& hull) { hull.bounds.max().x() = bad; }),
                  "mover 0 has a hull whose bounds are empty, not finite or out of range");
        const std::string of_half_space =
            "mover 0 has a half space whose normal has not length 1 or whose distance is out of range";
        EXPECT_EQ(flaw([&](MoverShape&, ConvexHull& hull) { hull.half_spaces[5].distance = bad; }),
                  of_half_space);
        EXPECT_EQ(flaw([&](MoverShape&, ConvexHull& hull) { hull.half_spaces[5].normal.y() = bad; }),
                  of_half_space);
    }
    EXPECT_EQ(flaw([](MoverShape& mover, ConvexHull&) { mover.balls[0].radius = 0.0F; }),
              "mover 1 has a ball that is not finite, out of range or without a radius");
    EXPECT_EQ(flaw([](MoverShape&, ConvexHull& hull) { hull.bounds.setEmpty(); }),
              "mover 0 has a hull whose bounds are empty, not finite or out of range");
    for (const std::size_t count : {3U, 65U})
        EXPECT_EQ(
            flaw([&](MoverShape&, ConvexHull& hull) { hull.half_spaces.resize(count, hull.half_spaces[0]); }),
            "mover 0 has a hull with too few or too many half spaces");
    EXPECT_EQ(find_movers_flaw(std::vector(257, good[0])), "there are too many movers");
}

TEST_F(CheckTest, NumbersThatAreNotFiniteOrTooLarge) {
    for (const float bad : {NAN, INFINITY, -INFINITY, 2.0F * coordinate_limit}) {
        Mesh broken = mesh;
        broken.vertices[5].y = bad;
        EXPECT_EQ(broken.flaw(), "vertex 5 is not finite or out of range");
        broken = mesh;
        broken.vertices[7].free_distance = bad;
        EXPECT_EQ(broken.flaw(), "vertex 7 is not finite or out of range");
    }
}

TEST_F(CheckTest, Triangles) {
    Mesh broken = mesh;
    broken.triangles[3].c = static_cast<std::uint32_t>(mesh.vertices.size());
    EXPECT_EQ(broken.flaw(), "triangle 3 has a corner that does not exist");
    broken = mesh;
    broken.triangles[3].c = broken.triangles[3].a;
    EXPECT_EQ(broken.flaw(), "triangle 3 has a corner twice");
}

TEST_F(CheckTest, Hints) {
    Mesh broken = mesh;
    ++broken.hints.extent[2];
    EXPECT_EQ(broken.flaw(), "the grid of hints does not fit its size");
    broken = mesh;
    broken.hints.extent = {1U << 31U, 1U << 31U, 4};
    EXPECT_EQ(broken.flaw(), "the grid of hints is too large");
    for (const float bad : {0.0F, -1.0F, NAN, INFINITY}) {
        broken = mesh;
        broken.hints.cell_size = bad;
        EXPECT_EQ(broken.flaw(), "the grid of hints does not fit its size");
    }
    broken = mesh;
    broken.hint_triangles[3] = static_cast<std::uint32_t>(mesh.triangles.size());
    EXPECT_EQ(broken.flaw(), "hint 3 is a triangle that does not exist");
}

TEST_F(CheckTest, FixedShots) {
    const FixedShot good{Vec3f(1.0F, 2.0F, 3.0F), -6.0F, 1.5F, 1};
    EXPECT_EQ(find_fixed_shots_flaw(std::vector(16, good), 2), "");
    EXPECT_EQ(find_fixed_shots_flaw(std::vector{FixedShot{good.position, good.yaw, good.pitch}}, 0), "");
    EXPECT_EQ(find_fixed_shots_flaw(std::vector(17, good), 2), "there are too many fixed shots");
    EXPECT_EQ(find_fixed_shots_flaw(std::vector{good, good}, 1),
              "fixed shot 0 is named by a spawn point that does not exist");
    for (const float bad : {NAN, INFINITY, 3e38F, 7.0F})
        for (const FixedShot& shot : {FixedShot{good.position, bad}, FixedShot{good.position, 0.0F, bad}})
            EXPECT_EQ(find_fixed_shots_flaw(std::vector{good, shot}, 2),
                      "fixed shot 1 is not finite or out of range");
    const FixedShot outside{Vec3f(NAN, 0.0F, 0.0F)};
    EXPECT_EQ(find_fixed_shots_flaw(std::vector{outside}, 2), "fixed shot 0 is not finite or out of range");
}

}  // namespace
}  // namespace camdir::freespace
