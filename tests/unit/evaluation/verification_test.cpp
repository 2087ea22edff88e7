// Representations made up for a room whose every clearance is known: verify must find what is wrong with
// them.
#include "evaluation/verification.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <random>

#include "oracle/reachability.hpp"
#include "support/clouds.hpp"
#include "support/freespace_meshes.hpp"
#include "support/oracle_twins.hpp"
#include "support/q3_maps.hpp"

namespace camdir::evaluation {
namespace {

// 512 x 512 x 128, with a closed closet and two spawn points, eyes at (-64, 0, 59) and (64, 0, 59).
const Box3d room(Vec3d(-256.0, -256.0, 0.0), Vec3d(256.0, 256.0, 128.0));
constexpr float d0 = 16.0F;
constexpr float middle = 64.0F;

scene::Scene make_room() {
    scene::q3::Bsp bsp = test::room_map(room);
    const Box3d closet(Vec3d(150.0, 150.0, 0.0), Vec3d(250.0, 250.0, 127.0));
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
        for (const bool low : {true, false}) {
            Box3d side = closet;
            (low ? side.max() : side.min())[axis] = low ? closet.min()[axis] + 8.0 : closet.max()[axis] - 8.0;
            test::add_box(bsp, side, test::stone);
        }
    }
    test::add_spawn_point(bsp, {-64.0, 0.0, 24.0});
    test::add_spawn_point(bsp, {64.0, 0.0, 24.0});
    return test::scene_of(bsp);
}

// Two triangles over a square in the middle of the room's height.
void add_square(freespace::Contents& contents, const Vec3f& centre, float half_side, float radius) {
    const auto first = static_cast<std::uint32_t>(contents.vertices.size());
    for (const auto& [x, y] : {std::pair{-1.0F, -1.0F}, {1.0F, -1.0F}, {1.0F, 1.0F}, {-1.0F, 1.0F}}) {
        contents.vertices.push_back(
            {centre.x() + x * half_side, centre.y() + y * half_side, centre.z(), radius});
    }
    contents.triangles.push_back({first, first + 1, first + 2});
    contents.triangles.push_back({first, first + 2, first + 3});
}

freespace::Contents contents_with(const Vec3f& centre, float half_side, float radius) {
    freespace::Contents contents = test::empty_contents();
    contents.metadata.d0 = d0;
    add_square(contents, centre, half_side, radius);
    return contents;
}

class VerificationTest : public testing::Test {
  protected:
    [[nodiscard]] Result<Verification> run(const freespace::Contents& contents,
                                           const VerificationParameters& parameters,
                                           const std::stop_token& stop = {}) const {
        return verify(
            test::make_freespace(contents), scene_, oracle_, parameters,
            [](std::string_view, std::uint64_t, std::uint64_t) {}, stop);
    }
    [[nodiscard]] Verification run(const freespace::Contents& contents) const {
        return run(contents, {5000, 5000, 3}).value();
    }

    scene::Scene scene_ = make_room();
    oracle::Oracle oracle_{scene_};
};

constexpr auto inside = static_cast<std::size_t>(BallFault::surface_inside);
constexpr auto in_solid = static_cast<std::size_t>(BallFault::centre_in_solid);
constexpr auto unreachable = static_cast<std::size_t>(BallFault::centre_unreachable);

TEST_F(VerificationTest, SafeRepresentationPasses) {
    const Verification result = run(contents_with({0, 0, middle}, 100.0F, 64.0F));
    EXPECT_FALSE(result.has_violation());
    EXPECT_EQ(result.by_area.tested, 2500U);
    EXPECT_EQ(result.by_triangle.tested, 2500U);
    EXPECT_EQ(result.at_vertices.tested, 4U);
    EXPECT_EQ(result.at_edges.tested, 5U) << "the diagonal belongs to both triangles";
    EXPECT_EQ(result.spawn_points, 2U);
    EXPECT_EQ(result.covered_spawn_points, 2U);
    EXPECT_EQ(result.joined_spawn_points, 2U);
    EXPECT_EQ(result.components, 1U);
}

TEST_F(VerificationTest, ToleranceIsTwoHundredthsOfAUnit) {
    EXPECT_FALSE(run(contents_with({0, 0, middle}, 100.0F, 64.015F)).has_violation());
    const Verification result = run(contents_with({0, 0, middle}, 100.0F, 64.1F));
    EXPECT_TRUE(result.has_violation());
    EXPECT_EQ(result.by_area.unsafe[inside], 2500U);
    EXPECT_EQ(result.at_vertices.unsafe_count(), 4U);
    EXPECT_NEAR(result.at_vertices.deepest[inside]->excess, 0.1, 1e-4);
    EXPECT_GT(result.overestimates, 0U);
    EXPECT_NEAR(result.largest_overestimate, 0.1, 1e-3);
}

TEST_F(VerificationTest, ToleranceScalesWithTheUnit) {
    scene_.metres_per_unit = 1.5 * 0.0254;  // the tolerance is 0.0133 units
    EXPECT_TRUE(run(contents_with({0, 0, middle}, 100.0F, 64.015F)).has_violation());
}

TEST_F(VerificationTest, CentresInSolidAndInTheClosetAreUnsafe) {
    freespace::Contents contents = contents_with({0, 0, middle}, 100.0F, 50.0F);
    add_square(contents, {0, 0, -8.0F}, 20.0F, 0.5F);
    add_square(contents, {200.0F, 200.0F, middle}, 20.0F, 5.0F);
    const Verification result = run(contents);
    EXPECT_EQ(result.at_vertices.unsafe[in_solid], 4U);
    EXPECT_EQ(result.at_vertices.unsafe[unreachable], 4U);
    EXPECT_EQ(result.at_vertices.unsafe[inside], 0U);
    EXPECT_EQ(result.at_vertices.deepest[in_solid]->centre.z(), -8.0);
    // A third of the triangles each, but a small part of the area.
    EXPECT_NEAR(static_cast<double>(result.by_triangle.unsafe[in_solid]), 2500.0 / 3.0, 120.0);
    const double share = 40.0 * 40.0 / (200.0 * 200.0 + 2 * 40.0 * 40.0);
    EXPECT_NEAR(static_cast<double>(result.by_area.unsafe[in_solid]), 2500.0 * share, 60.0);
}

TEST_F(VerificationTest, BallsWithoutRadiusClaimNothing) {
    const Verification result = run(contents_with({0, 0, -8.0F}, 20.0F, -1.0F));
    EXPECT_FALSE(result.has_violation());
    EXPECT_EQ(result.at_vertices.skipped, 4U);
    EXPECT_EQ(result.by_area.skipped, 2500U);
    EXPECT_EQ(result.covered_spawn_points, 0U);
    EXPECT_EQ(result.coverage[0].covered, 0U);
    EXPECT_EQ(result.tightness, 0.0);
}

// Coverage and tightness as one would compute them by hand: the square's slab is what lies within 60 of it.
TEST_F(VerificationTest, CoverageAndTightnessAreThoseOfTheSlab) {
    const Verification result = run(contents_with({0, 0, middle}, 100.0F, 60.0F), {10, 20000, 4}).value();
    const std::array<double, 3> thresholds = {0.0, d0, 2.0 * d0};
    std::array<double, 3> points{};
    std::array<double, 3> covered{};
    double ratios = 0.0;
    const auto reachability = oracle::Reachability::explore(oracle_, scene_, {}, {}).value();
    std::mt19937 random(5);
    for (int i = 0; i < 40000; ++i) {
        const Vec3d point = test::random_point_in(random, room);
        const double clearance = oracle_.clearance(point);
        if (!reachability.reachable(point)) continue;
        const Vec3d nearest(std::clamp(point.x(), -100.0, 100.0), std::clamp(point.y(), -100.0, 100.0),
                            middle);
        const double reported = std::max(60.0 - (point - nearest).norm(), 0.0);
        for (std::size_t bucket = 0; bucket < 3; ++bucket) {
            if (clearance <= thresholds[bucket]) continue;
            ++points[bucket];
            covered[bucket] += reported > 0.0 ? 1.0 : 0.0;
        }
        if (clearance > d0) ratios += reported / clearance;
    }
    EXPECT_EQ(result.coverage[0].points, 20000U);
    for (std::size_t bucket = 0; bucket < 3; ++bucket) {
        EXPECT_NEAR(result.coverage[bucket].share(), covered[bucket] / points[bucket], 0.015) << bucket;
    }
    EXPECT_NEAR(static_cast<double>(result.coverage[1].points) / 20000.0, points[1] / points[0], 0.015);
    EXPECT_NEAR(result.tightness, ratios / points[1], 0.015);
}

TEST_F(VerificationTest, SpawnPointsInDifferentComponentsAreReported) {
    freespace::Contents contents = contents_with({-64.0F, 0, middle}, 20.0F, 50.0F);
    add_square(contents, {64.0F, 0, middle}, 20.0F, 50.0F);
    const Verification apart = run(contents);
    EXPECT_EQ(apart.covered_spawn_points, 2U);
    EXPECT_EQ(apart.joined_spawn_points, 1U);
    EXPECT_EQ(apart.components, 2U);
    // A triangle whose far corner is not free does not join them.
    contents.vertices.push_back({0.0F, 0.0F, middle, -1.0F});
    contents.triangles.push_back({1, 4, 8});
    contents.vertices[1].free_distance = -1.0F;
    EXPECT_EQ(run(contents).joined_spawn_points, 1U);
    contents.vertices[1].free_distance = 50.0F;
    EXPECT_EQ(run(contents).joined_spawn_points, 2U);
    EXPECT_EQ(run(contents).components, 1U) << "the vertex that is not free is none";
}

void expect_equal(const BallCounts& a, const BallCounts& b) {
    EXPECT_EQ(a.tested, b.tested);
    EXPECT_EQ(a.unsafe, b.unsafe);
    for (std::size_t fault = 0; fault < a.deepest.size(); ++fault) {
        ASSERT_EQ(a.deepest[fault].has_value(), b.deepest[fault].has_value());
        if (a.deepest[fault]) {
            EXPECT_EQ(a.deepest[fault]->centre, b.deepest[fault]->centre);
        }
    }
}

TEST_F(VerificationTest, ThreadsDoNotChangeTheResult) {
    // Partly above the ceiling and partly in the closet, so that there is much to find.
    freespace::Contents contents = contents_with({120.0F, 120.0F, 80.0F}, 120.0F, 47.0F);
    const VerificationParameters parameters{20000, 20000, 9};
    const Verification many = run(contents, parameters).value();
    const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
    const Verification one = run(contents, parameters).value();
    EXPECT_TRUE(one.has_violation());
    expect_equal(one.by_area, many.by_area);
    expect_equal(one.by_triangle, many.by_triangle);
    EXPECT_EQ(one.tightness, many.tightness);
    EXPECT_EQ(one.coverage[2].covered, many.coverage[2].covered);
    const Verification other = run(contents, {20000, 20000, 10}).value();
    EXPECT_NE(one.by_area.unsafe, other.by_area.unsafe) << "another seed draws other balls";
}

TEST_F(VerificationTest, StopIsObeyed) {
    std::stop_source stop;
    stop.request_stop();
    const auto result = run(contents_with({0, 0, middle}, 100.0F, 60.0F), {}, stop.get_token());
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, ErrorCode::interrupted);
}

TEST_F(VerificationTest, StopIsObeyedInEveryStage) {
    for (const std::string_view last : {"cells explored", "coverage", "balls by area", "balls at edges"}) {
        std::stop_source stop;
        const auto result = verify(
            test::make_freespace(contents_with({0, 0, middle}, 100.0F, 60.0F)), scene_, oracle_, {},
            [&](std::string_view stage, std::uint64_t, std::uint64_t) {
                if (stage == last) stop.request_stop();
            },
            stop.get_token());
        ASSERT_FALSE(result) << last;
        EXPECT_EQ(result.error().code, ErrorCode::interrupted) << last;
    }
}

TEST_F(VerificationTest, SceneThatIsTooLargeToExploreIsRefused) {
    scene_.source = "plain.obj";
    scene_.bounds.extend(Vec3d::Constant(4e4));
    const auto result = run(contents_with({0, 0, middle}, 100.0F, 60.0F), {});
    ASSERT_FALSE(result);
    EXPECT_THAT(result.error().message, testing::StartsWith("plain.obj: the bounds of"));
}

TEST_F(VerificationTest, SceneWithoutAFreeSpawnPointIsRefused) {
    scene_.spawn_points = {{Vec3d(0.0, 0.0, -8.0), 0.0, "seed"}};
    const auto result = run(contents_with({0, 0, middle}, 100.0F, 60.0F), {});
    ASSERT_FALSE(result);
    EXPECT_THAT(result.error().message, testing::HasSubstr("no spawn point"));
}

// A room of points 16 apart, obstacles to a distance of d0 around each.
class CloudVerification : public testing::Test {
  protected:
    CloudVerification() {
        scene_.metres_per_unit = 0.0254;
        scene_.points = test::walls_of(room, 16.0);
        scene_.bounds = room;
        scene_.spawn_points.push_back({Vec3d(0.0, 0.0, middle), 0.0, "seed"});
    }
    [[nodiscard]] Verification run(const Vec3f& centre, float radius) const {
        const oracle::Oracle oracle(scene_, d0);
        return verify(test::make_freespace(contents_with(centre, 100.0F, radius)), scene_, oracle,
                      {2000, 2000, 3}, [](std::string_view, std::uint64_t, std::uint64_t) {}, {})
            .value();
    }
    scene::Scene scene_;
};

TEST_F(CloudVerification, BallsMayComeAsNearAsD0ToAPoint) {
    const Verification result = run({0, 0, middle}, middle - d0);
    EXPECT_FALSE(result.has_violation());
    EXPECT_EQ(result.by_area.tested, 1000U);
    EXPECT_GT(result.coverage[1].points, 0U);
    EXPECT_GT(result.coverage[1].covered, 0U);
    EXPECT_LT(result.coverage[1].covered, result.coverage[1].points);
}

TEST_F(CloudVerification, BallsThatComeNearerAreUnsafe) {
    const Verification result = run({0, 0, middle}, middle - d0 + 1.0F);
    EXPECT_GT(result.unsafe_balls(), 0U);
    EXPECT_GT(result.overestimates, 0U);
}

TEST_F(CloudVerification, CentresInAPointsBallAreUnsafe) {
    const Verification result = run({0, 0, 10.0F}, 5.0F);
    EXPECT_EQ(result.at_vertices.unsafe_count(), result.at_vertices.tested);
    EXPECT_GT(result.by_area.unsafe[in_solid], 0U);
}

}  // namespace
}  // namespace camdir::evaluation
