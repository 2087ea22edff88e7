#include "bake/bake.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "bake/geometry/certificate.hpp"
#include "scene/load.hpp"
#include "support/openarena.hpp"
#include "support/solid_scenes.hpp"
#include "unit/bake/counts.hpp"
#include "unit/bake/safety.hpp"

namespace camdir::bake {
namespace {

using test::SolidScene;

// Without reduction, which reduce_test.cpp tests.
Baked baked(const SolidScene& scene, double d0, unsigned threads = 0) {
    return bake(scene.scene(), {d0, threads, 0.0, 0}, {}, {}).value();
}

Baked baked(const scene::Scene& scene, double d0, Sampling sampling) {
    Parameters parameters;
    parameters.d0 = d0;
    parameters.loss = 0.0;
    parameters.sampling = sampling;
    return bake(scene, parameters, {}, {}).value();
}

bool covered(const std::vector<Slab>& slabs, const Vec3d& p) {
    return std::any_of(slabs.begin(), slabs.end(), [&](const Slab& slab) {
        return slab.min_gap(Triangle3d{p, p, p}) < 0.0 && slab.signed_gap(Triangle3d{p, p, p}).value < 0.0;
    });
}

struct Coverage {
    int points = 0;
    int covered = 0;
    [[nodiscard]] double share() const { return static_cast<double>(covered) / points; }
};

// Of random points of `region` with clearance > `clearance`.
Coverage coverage(const SolidScene& scene, const freespace::Contents& contents, const Box3d& region,
                  double clearance) {
    std::mt19937 random(18);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    const std::vector<Slab> slabs = slabs_of(contents);
    Coverage result;
    while (result.points < 500) {
        const Vec3d p =
            region.min() + Vec3d(unit(random), unit(random), unit(random)).cwiseProduct(region.sizes());
        if (scene.clearance(p) <= clearance) continue;
        ++result.points;
        result.covered += covered(slabs, p);
    }
    return result;
}

const Box3d room_box(Vec3d(0, 0, 0), Vec3d(256, 192, 128));
const Box3d first_room(Vec3d(-264, -128, 0), Vec3d(-8, 128, 128));
const Box3d second_room(Vec3d(8, -128, 0), Vec3d(264, 128, 128));

TEST(Bake, OfARoomIsSafeAndCoversIt) {
    const SolidScene room = test::box_room();
    const Baked result = baked(room, 16.0);
    expect_safe(room, result.contents);
    EXPECT_EQ(coverage(room, result.contents, room_box, 16.0).share(), 1.0);
    EXPECT_GT(coverage(room, result.contents, room_box, 0.0).share(), 0.93);
}

TEST(Bake, OfARoomWithAPillarIsSafeAndCoversIt) {
    const SolidScene room = test::pillar_room();
    const Baked result = baked(room, 16.0);
    expect_safe(room, result.contents);
    EXPECT_EQ(coverage(room, result.contents, room_box, 16.0).share(), 1.0);
}

// Of a triangular prism along x: a duct whose balls touch three walls.
scene::Scene duct(double radius) {
    scene::Scene scene = test::box_room().scene();
    scene.brushes.clear();
    scene.planes.clear();
    scene.vertices.clear();
    for (const double x : {0.0, 400.0})
        for (const double angle : {90.0, 210.0, 330.0})
            scene.vertices.emplace_back(x, 2.0 * radius * std::cos(angle * radians_of_a_degree<double>),
                                        2.0 * radius * std::sin(angle * radians_of_a_degree<double>));
    scene.triangles = {{0, 1, 2}, {3, 4, 5}};
    for (std::uint32_t i = 0; i < 3; ++i) {
        const std::uint32_t next = (i + 1) % 3;
        scene.triangles.push_back({i, next, next + 3});
        scene.triangles.push_back({i, next + 3, i + 3});
    }
    scene.bounds = Box3d(Vec3d(0, -2.0 * radius, -2.0 * radius), Vec3d(400, 2.0 * radius, 2.0 * radius));
    scene.spawn_points = {{{200, 0, 0}, 0.0, "made"}};
    return scene;
}

// Its samples are sqrt(3) radii apart.
TEST(Bake, CoversADuctSlightlyWiderThanD0) {
    const Baked result = baked(duct(21.0), 16.0, Sampling::adaptive);
    const std::vector<Slab> slabs = slabs_of(result.contents);
    for (int x = 20; x <= 380; x += 5)
        EXPECT_TRUE(covered(slabs, {static_cast<double>(x), 0, 0})) << x;
}

// The room without its ceiling, in open space, as a mesh without volumes.
struct Yard {
    Yard() {
        scene.brushes.clear();
        scene.planes.clear();
        scene.triangles.resize(scene.triangles.size() - 12);
        const Vec3d around(100, 100, 200);
        scene.bounds = Box3d(scene.bounds.min() - around, scene.bounds.max() + around);
        for (std::size_t i = 0; i + 1 < room.scene().brushes.size(); ++i)
            walls.push_back(room.scene().brushes[i].bounds);
    }

    [[nodiscard]] double clearance(const Vec3d& p) const {
        double nearest = std::numeric_limits<double>::infinity();
        for (const Box3d& wall : walls)
            nearest = std::min(nearest, wall.exteriorDistance(p));
        return nearest;
    }

    SolidScene room = test::box_room();
    scene::Scene scene = room.scene();
    std::vector<Box3d> walls;
};

TEST(Bake, OfAnOpenYardReachesTheBounds) {
    const Yard yard;
    const Baked result = baked(yard.scene, 16.0, Sampling::adaptive);
    for (const freespace::Vertex& vertex : result.contents.vertices) {
        const Vec3d p = vertex.position().cast<double>();
        ASSERT_TRUE(yard.scene.bounds.contains(p));
        ASSERT_LE(vertex.free_distance, yard.clearance(p) + 1e-6);
    }
    std::mt19937 random(21);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    const std::vector<Slab> slabs = slabs_of(result.contents);
    for (int i = 0; i < 2000; ++i) {
        const Vec3d share(unit(random), unit(random), unit(random));
        const Vec3d p = yard.scene.bounds.min() + share.cwiseProduct(yard.scene.bounds.sizes());
        EXPECT_TRUE(yard.clearance(p) <= 16.0 || covered(slabs, p)) << p.transpose();
    }
}

TEST(Bake, WithoutSpawnPointsAnOpenYardsWidestPlaceIsInsideIt) {
    Yard yard;
    yard.scene.spawn_points.clear();
    const Baked result = baked(yard.scene, 16.0, Sampling::adaptive);
    ASSERT_EQ(result.contents.spawn_points.size(), 1U);
    const Vec3d place = result.contents.spawn_points[0].eye.cast<double>();
    EXPECT_GT(yard.clearance(place), 90.0);
    EXPECT_GT(depth_in(room_box, Vec3d(place.x(), place.y(), 64.0)), 60.0);
    EXPECT_GT(depth_in(yard.scene.bounds, place), 80.0);
    EXPECT_EQ(count_of(result, "pack", "covered spawn points"), 1.0);
}

TEST(Bake, SmallD0KeepsTheDoorOpen) {
    const SolidScene rooms = test::two_rooms();
    const Baked result = baked(rooms, 16.0);
    expect_safe(rooms, result.contents);
    EXPECT_EQ(coverage(rooms, result.contents, first_room, 16.0).share(), 1.0);
    EXPECT_EQ(coverage(rooms, result.contents, second_room, 16.0).share(), 1.0);
}

TEST(Bake, LargeD0ClosesTheDoor) {
    const SolidScene rooms = test::two_rooms();
    const Baked result = baked(rooms, 48.0);
    expect_safe(rooms, result.contents);
    EXPECT_GT(coverage(rooms, result.contents, first_room, 48.0).share(), 0.999);
    for (const freespace::Vertex& v : result.contents.vertices)
        ASSERT_LT(v.x, 8.0F);
}

// Two halls of 640 x 640 x 480 joined by a door of 48 x 80 in a wall of 16.
TEST(Bake, AdaptiveSamplingKeepsASmallDoorBetweenWideHalls) {
    SolidScene halls(Box3d(Vec3d(-648, -320, 0), Vec3d(648, 320, 480)));
    halls.add(Box3d(Vec3d(-8, -320, 0), Vec3d(8, -24, 480)));
    halls.add(Box3d(Vec3d(-8, 24, 0), Vec3d(8, 320, 480)));
    halls.add(Box3d(Vec3d(-8, -24, 80), Vec3d(8, 24, 480)));
    halls.spawn({-300, 0, 50});
    const Baked adaptive = baked(halls.scene(), 16.0, Sampling::adaptive);
    expect_safe(halls, adaptive.contents);
    for (const Box3d& hall :
         {Box3d(Vec3d(-648, -320, 0), Vec3d(-8, 320, 480)), Box3d(Vec3d(8, -320, 0), Vec3d(648, 320, 480))})
        EXPECT_GE(coverage(halls, adaptive.contents, hall, 16.0).share(), 0.998);
    const Box3d door(Vec3d(-8, -24, 0), Vec3d(8, 24, 80));
    EXPECT_EQ(coverage(halls, adaptive.contents, door, 16.0).share(), 1.0);

    const Baked uniform = baked(halls.scene(), 16.0, Sampling::uniform);
    EXPECT_LT(1.2 * count_of(adaptive, "weld", "samples"), count_of(uniform, "weld", "samples"));
}

TEST(Bake, AdaptiveSamplesOfAHallGrowSlowerThanItsArea) {
    const auto samples_of = [](double side, Sampling sampling) {
        SolidScene hall(Box3d(Vec3d(0, 0, 0), Vec3d::Constant(side)));
        hall.spawn(Vec3d::Constant(0.5 * side));
        return count_of(baked(hall.scene(), 32.0, sampling), "weld", "samples");
    };
    EXPECT_GT(samples_of(2048.0, Sampling::uniform), 12.0 * samples_of(512.0, Sampling::uniform));
    EXPECT_LT(samples_of(2048.0, Sampling::adaptive), 9.0 * samples_of(512.0, Sampling::adaptive));
}

TEST(Bake, TheCoarsestSamplingDistanceIsLimited) {
    Parameters parameters;
    parameters.coarsest = 1.0;
    const SolidScene room = test::box_room();
    const Baked limited = bake(room.scene(), parameters, {}, {}).value();
    EXPECT_EQ(count_of(limited, "weld", "samples"),
              count_of(baked(room.scene(), 16.0, Sampling::uniform), "weld", "samples"));
    for (const double coarsest : {0.5, 65.0, std::numeric_limits<double>::quiet_NaN()}) {
        parameters.coarsest = coarsest;
        EXPECT_THAT(bake(room.scene(), parameters, {}, {}).error().message,
                    testing::HasSubstr("from 1 to 64"));
    }
}

class RealMap : public testing::TestWithParam<double> {};

TEST_P(RealMap, AdaptiveSamplingFindsWhatUniformFinds) {
    const auto map = test::openarena_map("oa_dm1");
    if (!map) GTEST_SKIP() << test::needs_openarena_map("oa_dm1");
    const scene::Scene scene = scene::load(*map).value();
    const auto of = [&](Sampling sampling) {
        Parameters parameters;
        parameters.d0 = 32.0;
        parameters.loss = GetParam();
        parameters.sampling = sampling;
        return bake(scene, parameters, {}, {}).value();
    };
    const Baked adaptive = of(Sampling::adaptive);
    const Baked uniform = of(Sampling::uniform);
    EXPECT_LE(count_of(adaptive, "weld", "samples"), count_of(uniform, "weld", "samples"));
    EXPECT_EQ(count_of(adaptive, "pack", "covered spawn points"),
              count_of(uniform, "pack", "covered spawn points"));
    EXPECT_EQ(count_of(adaptive, "inside", "connected spawn points"),
              count_of(uniform, "inside", "connected spawn points"));
    if (GetParam() == 0.0) {
        EXPECT_LE(adaptive.contents.triangles.size(), uniform.contents.triangles.size());
    }
    const Obstacles obstacles(scene);
    for (const Slab& slab : slabs_of(adaptive.contents))
        ASSERT_TRUE(is_certified(slab, obstacles));
}

INSTANTIATE_TEST_SUITE_P(Losses, RealMap, testing::Values(0.0, Parameters().loss));

TEST(Sampling, IsNamed) {
    EXPECT_EQ(sampling_named("adaptive"), Sampling::adaptive);
    EXPECT_EQ(sampling_named("uniform"), Sampling::uniform);
    EXPECT_EQ(sampling_named("Uniform"), std::nullopt);
    EXPECT_EQ(name_of(Sampling::uniform), "uniform");
}

TEST(Bake, WorksInAnyUnit) {
    const SolidScene room = test::box_room();
    scene::Scene metres = room.scene();
    metres.metres_per_unit = 1.0;
    for (Vec3d& p : metres.vertices)
        p *= 0.0254;
    metres.bounds = Box3d(metres.bounds.min() * 0.0254, metres.bounds.max() * 0.0254);
    metres.brushes.clear();
    metres.spawn_points[0].eye *= 0.0254;
    const Baked result = bake(metres, {16.0, 0, 0.0, 0}, {}, {}).value();
    EXPECT_NEAR(result.contents.metadata.d0, 16.0 * 0.0254, 1e-6);
    scene::Scene units = room.scene();
    units.brushes.clear();
    const Baked expected = baked(units, 16.0, Sampling::adaptive);
    EXPECT_NEAR(static_cast<double>(result.contents.triangles.size()),
                static_cast<double>(expected.contents.triangles.size()),
                0.05 * static_cast<double>(expected.contents.triangles.size()));
}

TEST(Bake, IsTheSameForAnyNumberOfThreads) {
    const SolidScene rooms = test::two_rooms();
    const auto bytes = freespace::encode(baked(rooms, 12.0, 1).contents);
    EXPECT_EQ(freespace::encode(baked(rooms, 12.0, 2).contents), bytes);
}

// A map may name any number of classes, but a MAP.vfs holds a limited number of counts.
TEST(Bake, SumsWhatIsSkippedForTooManyReasons) {
    scene::Scene scene = test::box_room().scene();
    for (int i = 0; i < 20'000; ++i)
        scene.skipped.push_back({"unknown class: " + std::to_string(i), "", 2});
    const auto baked = bake(scene, {32.0, 0}, {}, {});
    ASSERT_TRUE(baked);
    const std::vector<freespace::Count>& counts = baked->stages.front().counts;
    EXPECT_EQ(counts.size(), 1'001U);
    EXPECT_EQ(counts.back().what, "other reasons");
    EXPECT_EQ(counts.back().value, 2.0 * 19'000);
    EXPECT_TRUE(freespace::Freespace::parse(freespace::encode(baked->contents), "room"));
}

TEST(Bake, ReportsEveryStageAndItsProgress) {
    std::vector<std::string> shown;
    std::vector<std::string> finished;
    const auto progress = [&](const Progress& p) {
        EXPECT_TRUE(p.done <= p.total || p.total == 0);
        if (shown.empty() || shown.back() != p.stage) shown.emplace_back(p.stage);
    };
    const auto result = bake(test::box_room().scene(), {16.0, 0}, progress, {},
                             [&](const StageReport& report) { finished.push_back(report.stage); });
    ASSERT_TRUE(result);
    EXPECT_EQ(shown, finished);
    EXPECT_THAT(finished,
                testing::ElementsAre("medial axis", "forecast", "sample", "weld", "delaunay", "voronoi",
                                     "triangulate", "clearance", "crossing", "inside", "certify", "reduce",
                                     "pack", "recertify", "movers", "fixed shots"));
    const auto& counts = result->contents.metadata.counts;
    const auto covered_spawns = std::find_if(counts.begin(), counts.end(), [](const freespace::Count& count) {
        return count.stage == "pack" && count.what == "covered spawn points";
    });
    ASSERT_NE(covered_spawns, counts.end());
    EXPECT_EQ(covered_spawns->value, 1.0);
}

TEST(Bake, StopsInEveryStage) {
    const SolidScene room = test::box_room();
    for (const char* stage : {"medial axis", "sample", "weld", "delaunay", "voronoi", "triangulate",
                              "clearance", "crossing", "inside", "certify", "reduce", "pack"}) {
        std::stop_source stop;
        const auto request = [&](const Progress& p) {
            if (p.stage == stage) stop.request_stop();
        };
        const auto result = bake(room.scene(), {16.0, 2, 1.0, 0}, request, stop.get_token());
        ASSERT_FALSE(result) << stage;
        EXPECT_EQ(result.error().code, ErrorCode::interrupted);
        EXPECT_THAT(result.error().message, testing::HasSubstr(stage));
    }
}

TEST(Bake, RefusesWhatItCannotBake) {
    scene::Scene empty = test::box_room().scene();
    empty.triangles.clear();
    EXPECT_THAT(bake(empty, {}, {}, {}).error().message,
                testing::HasSubstr("made.map: the scene has no obstacles"));

    const scene::Scene room = test::box_room().scene();
    for (const double d0 : {0.1, 1.9, 257.0, -1.0, std::numeric_limits<double>::quiet_NaN()})
        EXPECT_THAT(bake(room, {d0, 0}, {}, {}).error().message, testing::HasSubstr("from 2 to 256"));
    EXPECT_THAT(bake(room, {200.0, 0}, {}, {}).error().message, testing::HasSubstr("spawn points"));

    scene::Scene flat = room;
    for (Vec3d& p : flat.vertices)
        p.z() = 0.0;
    EXPECT_THAT(bake(flat, {}, {}, {}).error().message, testing::HasSubstr("one plane"));
}

}  // namespace
}  // namespace camdir::bake
