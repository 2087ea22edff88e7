#include "bake/geometry/box_tree.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "bake/geometry/obstacles.hpp"
#include "bake/geometry/solids.hpp"
#include "support/bake_twins.hpp"
#include "support/solid_scenes.hpp"

namespace camdir::bake {
namespace {

std::vector<Box3d> random_boxes(std::mt19937& random, int count) {
    std::uniform_real_distribution<double> coordinate(-100.0, 100.0);
    std::exponential_distribution<double> size(0.2);
    std::vector<Box3d> boxes;
    for (int i = 0; i < count; ++i) {
        const Vec3d p(coordinate(random), coordinate(random), coordinate(random));
        boxes.emplace_back(p, p + Vec3d(size(random), size(random), size(random)));
    }
    return boxes;
}

TEST(BoxTree, VisitsEveryItemOnce) {
    std::mt19937 random(6);
    for (const int count : {0, 1, 2, 5, 1000}) {
        const auto boxes = random_boxes(random, count);
        const BoxTree tree(boxes);
        std::vector<std::uint32_t> seen;
        tree.visit_where([](const Box3d&) { return true; },
                         [&](std::uint32_t position) { seen.push_back(tree.order()[position]); });
        std::sort(seen.begin(), seen.end());
        ASSERT_EQ(seen.size(), static_cast<std::size_t>(count));
        for (std::uint32_t i = 0; i < seen.size(); ++i)
            ASSERT_EQ(seen[i], i);
    }
}

// No split separates equal boxes; the tree must stay shallow enough for its visits.
TEST(BoxTree, TakesEqualBoxes) {
    const std::vector<Box3d> boxes(5000, Box3d(Vec3d(1, 1, 1), Vec3d(2, 2, 2)));
    const BoxTree tree(boxes);
    std::size_t seen = 0;
    tree.visit_where([](const Box3d&) { return true; }, [&](std::uint32_t) { ++seen; });
    EXPECT_EQ(seen, boxes.size());
}

TEST(BoxTree, TakesCentresThatDifferByTheSmallestNumbers) {
    std::vector<Box3d> boxes(5000, Box3d(Vec3d(0, 0, 0)));
    for (std::size_t i = 0; i < boxes.size(); ++i)
        boxes[i] = Box3d(Vec3d(i % 2 == 0 ? 0.0 : std::numeric_limits<double>::denorm_min(), 0.0, 0.0));
    const BoxTree tree(boxes);
    std::size_t seen = 0;
    tree.visit_where([](const Box3d&) { return true; }, [&](std::uint32_t) { ++seen; });
    EXPECT_EQ(seen, boxes.size());
}

TEST(BoxTree, FindsWhatASearchOverAllFinds) {
    std::mt19937 random(7);
    const auto boxes = random_boxes(random, 3000);
    const BoxTree tree(boxes);
    for (int round = 0; round < 200; ++round) {
        const Vec3d p = random_boxes(random, 1)[0].min();
        double nearest = std::numeric_limits<double>::infinity();
        tree.visit_by(
            [&](const Box3d& box) { return box.squaredExteriorDistance(p); }, [&] { return nearest; },
            [&](std::uint32_t position) {
                nearest = std::min(nearest, boxes[tree.order()[position]].squaredExteriorDistance(p));
            });
        double expected = std::numeric_limits<double>::infinity();
        for (const Box3d& box : boxes)
            expected = std::min(expected, box.squaredExteriorDistance(p));
        ASSERT_EQ(nearest, expected) << "round " << round;
    }
}

TEST(ClosestPoint, IsNearestOnTrianglesSegmentsAndPoints) {
    std::mt19937 random(8);
    std::uniform_real_distribution<double> coordinate(-10.0, 10.0);
    const auto point = [&] { return Vec3d(coordinate(random), coordinate(random), coordinate(random)); };
    for (int round = 0; round < 100; ++round) {
        Triangle3d t{point(), point(), point()};
        if (round % 4 == 1) t[2] = t[1];
        if (round % 4 == 2) t[2] = 0.25 * t[0] + 0.75 * t[1];
        if (round % 4 == 3) t[1] = t[2] = t[0];
        const Vec3d p = point();
        const double searched = test::searched_distance(p, t);
        ASSERT_NEAR((closest_point(t, p) - p).norm(), searched, 1e-4) << "round " << round;
        ASSERT_LE((closest_point(t, p) - p).norm(), searched + 1e-9) << "round " << round;
    }
}

TEST(Obstacles, DistanceIsTheClosedForm) {
    std::mt19937 random(9);
    const test::SolidScene room = test::pillar_room();
    const Obstacles obstacles(room.scene());
    std::uniform_real_distribution<double> x(0.0, 256.0);
    std::uniform_real_distribution<double> y(0.0, 192.0);
    std::uniform_real_distribution<double> z(0.0, 128.0);
    for (int round = 0; round < 2000; ++round) {
        const Vec3d p(x(random), y(random), z(random));
        if (room.clearance(p) == 0.0) continue;
        ASSERT_NEAR(obstacles.distance(p), room.clearance(p), 1e-9);
        ASSERT_NEAR(obstacles.distance(p, 20.0), std::min(20.0, room.clearance(p)), 1e-9);
    }
}

TEST(Solids, ContainTheirInsideAndSurface) {
    const test::SolidScene room = test::pillar_room();
    const Solids solids(room.scene());
    EXPECT_TRUE(solids.contains({160, 70, 64}));
    EXPECT_TRUE(solids.contains({150, 70, 64}));
    EXPECT_FALSE(solids.contains({149.999, 70, 64}));
    EXPECT_TRUE(solids.contains({-8, 70, 64}));
    EXPECT_FALSE(solids.contains({-17, 70, 64}));
    EXPECT_FALSE(Solids(scene::Scene{}).contains({0, 0, 0}));
}

// The pillar stands on the floor.
TEST(Solids, BuryWhatHasASolidOnBothSides) {
    const test::SolidScene room = test::pillar_room();
    const Solids solids(room.scene());
    const double offset = 0.01;
    EXPECT_TRUE(solids.is_buried({Vec3d(150, 60, 0), Vec3d(182, 60, 0), Vec3d(182, 92, 0)}, offset));
    EXPECT_TRUE(solids.is_buried({Vec3d(182, 60, 0), Vec3d(150, 60, 0), Vec3d(182, 92, 0)}, offset));
    EXPECT_FALSE(solids.is_buried({Vec3d(149, 60, 0), Vec3d(182, 60, 0), Vec3d(182, 92, 0)}, offset));
    EXPECT_FALSE(solids.is_buried({Vec3d(150, 60, 0), Vec3d(150, 92, 0), Vec3d(150, 60, 50)}, offset));
    EXPECT_FALSE(solids.is_buried({Vec3d(150, 60, 0), Vec3d(150, 60, 0), Vec3d(182, 92, 0)}, offset))
        << "a segment has no sides";
}

}  // namespace
}  // namespace camdir::bake
