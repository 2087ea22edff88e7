#include "bake/geometry/certificate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "support/bake_twins.hpp"
#include "support/solid_scenes.hpp"

namespace camdir::bake {
namespace {

struct Pair {
    Triangle3d corners;
    std::array<double, 3> free_distance;
    Triangle3d obstacle;
};

// Slabs and obstacles of every shape: far, near, crossing, coplanar, needles, segments and points; free
// distances that change slower and faster than the distance between their corners.
Pair random_pair(std::mt19937& random) {
    std::uniform_real_distribution<double> coordinate(-10.0, 10.0);
    const auto point = [&] { return Vec3d(coordinate(random), coordinate(random), coordinate(random)); };
    Pair pair{{point(), point(), point()}, {}, {point(), point(), point()}};
    std::uniform_real_distribution<double> radius(-3.0, 12.0);
    for (double& r : pair.free_distance)
        r = radius(random);
    const Vec3d shift = 20.0 * point().normalized();
    switch (random() % 8) {
        case 0:
            for (Vec3d& q : pair.obstacle)
                q += shift;
            break;
        case 1:
            for (Vec3d& q : pair.obstacle)
                q.z() = 0.0;
            for (Vec3d& p : pair.corners)
                p.z() = 3.0;
            break;
        case 2:
            for (Vec3d& q : pair.obstacle)
                q.z() = 0.0;
            for (Vec3d& p : pair.corners)
                p.z() = 0.0;
            break;
        case 3:
            pair.obstacle[2] = pair.obstacle[1];
            break;
        case 4:
            pair.obstacle[1] = pair.obstacle[2] = pair.obstacle[0];
            break;
        case 5:
            pair.corners[2] = 0.5 * (pair.corners[0] + pair.corners[1]) + 1e-3 * pair.corners[2];
            break;
        case 6:
            pair.free_distance[1] = pair.free_distance[2] = pair.free_distance[0];
            break;
        default:
            break;
    }
    return pair;
}

double free_distance_at(const Pair& pair, const std::array<double, 3>& weights) {
    return weights[0] * pair.free_distance[0] + weights[1] * pair.free_distance[1] +
           weights[2] * pair.free_distance[2];
}

TEST(Certificate, GapIsAttainedAndNoSearchFindsLess) {
    std::mt19937 random(13);
    for (int round = 0; round < 1000; ++round) {
        const Pair pair = random_pair(random);
        const SignedGap gap = Slab(pair.corners, pair.free_distance).signed_gap(pair.obstacle);
        ASSERT_NEAR(gap.weights[0] + gap.weights[1] + gap.weights[2], 1.0, 1e-9);
        for (const double w : gap.weights)
            ASSERT_GE(w, 0.0);
        const Vec3d m = test::point_of(pair.corners, gap.weights);
        const double attained =
            (closest_point(pair.obstacle, m) - m).norm() - free_distance_at(pair, gap.weights);
        ASSERT_NEAR(gap.value, attained, 1e-7) << "round " << round;
        ASSERT_LE(gap.value,
                  test::searched_signed_gap(pair.corners, pair.free_distance, pair.obstacle) + 1e-7)
            << "round " << round;
    }
}

TEST(Certificate, BoundsAreNeverAboveTheGap) {
    std::mt19937 random(14);
    int separated = 0;
    for (int round = 0; round < 20000; ++round) {
        const Pair pair = random_pair(random);
        const Slab slab(pair.corners, pair.free_distance);
        const double gap = slab.signed_gap(pair.obstacle).value;
        ASSERT_LE(slab.min_gap(pair.obstacle), gap + 1e-9) << "round " << round;
        ASSERT_LE(slab.min_gap(box_of(pair.obstacle)), gap + 1e-9) << "round " << round;
        separated += slab.min_gap(pair.obstacle) > 0.0;
    }
    EXPECT_GT(separated, 1000);
}

TEST(Certificate, OfASlabWithoutAreaIsThatOfItsSegmentOrPoint) {
    const Triangle3d wall{Vec3d(-50, -50, 0), Vec3d(50, -50, 0), Vec3d(0, 80, 0)};
    const Vec3d a(0, 0, 5);
    const Vec3d b(0, 4, 9);
    EXPECT_DOUBLE_EQ(Slab({a, a, a}, {3, 3, 3}).signed_gap(wall).value, 2.0);
    EXPECT_DOUBLE_EQ(Slab({a, b, b}, {3, 8, 8}).signed_gap(wall).value, 1.0);
}

TEST(Certificate, GapToASceneIsTheSmallestOfAllOrEnough) {
    std::mt19937 random(15);
    const test::SolidScene room = test::pillar_room();
    const Obstacles obstacles(room.scene());
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (int round = 0; round < 500; ++round) {
        Triangle3d corners;
        for (Vec3d& p : corners)
            p = Vec3d(256.0 * unit(random), 192.0 * unit(random), 128.0 * unit(random));
        const Slab slab(corners, {40.0 * unit(random), 40.0 * unit(random), 40.0 * unit(random)});
        double smallest = std::numeric_limits<double>::infinity();
        for (const Triangle3d& obstacle : obstacles.triangles())
            smallest = std::min(smallest, slab.signed_gap(obstacle).value);
        ASSERT_DOUBLE_EQ(signed_gap(slab, obstacles, 1000.0).value, smallest) << "round " << round;
        ASSERT_EQ(signed_gap(slab, obstacles, smallest - 1.0).value, smallest - 1.0) << "round " << round;
    }
}

TEST(Certificate, IsThatOfEveryObstacleWhateverTheHint) {
    std::mt19937 random(16);
    const test::SolidScene room = test::pillar_room();
    const Obstacles obstacles(room.scene());
    const auto count = static_cast<std::uint32_t>(obstacles.triangles().size());
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    int violating = 0;
    for (int round = 0; round < 2000; ++round) {
        const Vec3d middle(256.0 * unit(random), 192.0 * unit(random), 128.0 * unit(random));
        std::vector<Slab> slabs;
        for (int i = 0; i <= round % 3; ++i) {
            Triangle3d corners{middle, middle, middle};
            for (std::size_t k = slabs.empty() ? 0 : 1; k < 3; ++k)
                corners[k] += 40.0 * Vec3d(unit(random), unit(random), unit(random));
            slabs.emplace_back(corners,
                               std::array{30.0 * unit(random), 30.0 * unit(random), 30.0 * unit(random)});
        }
        const auto reach_into = [&](const Triangle3d& obstacle) {
            return std::any_of(slabs.begin(), slabs.end(),
                               [&](const Slab& slab) { return slab.signed_gap(obstacle).value < 0.0; });
        };
        const auto& triangles = obstacles.triangles();
        const bool violates = std::any_of(triangles.begin(), triangles.end(), reach_into);
        violating += violates;
        const auto hint =
            static_cast<std::uint32_t>(random() % (count + 1)) == count ? freespace::none : random() % count;
        const std::uint32_t found = find_violated(slabs, obstacles, static_cast<std::uint32_t>(hint));
        ASSERT_EQ(found != freespace::none, violates) << "round " << round;
        const bool certified = std::all_of(slabs.begin(), slabs.end(),
                                           [&](const Slab& slab) { return is_certified(slab, obstacles); });
        ASSERT_EQ(certified, !violates) << "round " << round;
        ASSERT_TRUE(!violates || reach_into(triangles[found])) << "round " << round;
    }
    EXPECT_GT(violating, 400);
    EXPECT_LT(violating, 1800);
}

}  // namespace
}  // namespace camdir::bake
