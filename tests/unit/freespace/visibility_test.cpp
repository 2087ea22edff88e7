#include "freespace/visibility.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "freespace/distance.hpp"
#include "freespace/space.hpp"
#include "support/freespace_meshes.hpp"
#include "support/freespace_twins.hpp"

namespace camdir::freespace {
namespace {

using test::covered_point;
using test::make_freespace;
using test::random_contents;
using test::random_point;
using test::sampled_clearance;
using test::square_contents;

TEST(Sight, AlongASquare) {
    const Freespace freespace = make_freespace(square_contents());
    const Sight clear = sight(freespace, {-20, 50, 5}, {120, 50, 5});
    EXPECT_TRUE(clear.clear);
    EXPECT_FLOAT_EQ(clear.free_length, 140.0F);
    EXPECT_GT(clear.clearance, 0.0F);
    EXPECT_LE(clear.clearance, 40.0F - std::hypot(20.0F, 5.0F)) << "that of its ends";
    EXPECT_NE(clear.triangle, none);
}

TEST(Sight, LeavesTheSquareWhereItsSlabsEnd) {
    const Freespace freespace = make_freespace(square_contents());
    const Sight blocked = sight(freespace, {50, 50, 0}, {50, 50, 100});
    EXPECT_FALSE(blocked.clear);
    EXPECT_NEAR(blocked.free_length, 40.0F, 1e-3F);
    const Sight sphere = sight(freespace, {50, 50, 0}, {50, 50, 100}, 15.0F);
    EXPECT_FALSE(sphere.clear);
    EXPECT_NEAR(sphere.free_length, 25.0F, 1e-3F);
}

TEST(Sight, OfAPointIsItsCoverage) {
    const Freespace freespace = make_freespace(square_contents());
    EXPECT_TRUE(sight(freespace, {50, 50, 30}, {50, 50, 30}).clear);
    EXPECT_FALSE(sight(freespace, {50, 50, 30}, {50, 50, 30}, 11.0F).clear);
    EXPECT_FALSE(sight(freespace, {50, 50, 41}, {50, 50, 41}).clear);
}

TEST(Sight, StrangeInputIsBlocked) {
    const Freespace freespace = make_freespace(square_contents());
    const Vec3f inside(50, 50, 0);
    for (const float strange : {NAN, INFINITY, -INFINITY}) {
        for (const Sight& seen :
             {sight(freespace, inside, {50, strange, 0}), sight(freespace, {strange, 50, 0}, inside),
              sight(freespace, inside, inside, std::abs(strange))}) {
            EXPECT_FALSE(seen.clear);
            EXPECT_EQ(seen.free_length, 0.0F);
        }
    }
    EXPECT_FALSE(sight(freespace, inside, {60, 50, 0}, -1.0F).clear);
    EXPECT_EQ(sight(freespace, inside, {60, 50, 0}, -1.0F).free_length, 0.0F);
    EXPECT_FALSE(sight(freespace, {50, 50, 41}, {60, 50, 41}, -30.0F).clear) << "in no slab";
    EXPECT_FALSE(sight(freespace, inside, {50, 3e38F, 0}).clear);
    EXPECT_FALSE(sight(make_freespace(test::empty_contents()), inside, inside).clear);
}

// What a sight promises: `free_length` of the segment has at least `clearance`, which is at least the radius.
void expect_safe(const Freespace& freespace, const Sight& seen, const Vec3f& from, const Vec3f& to,
                 float radius) {
    if (seen.triangle == none) return;
    const Vec3d start = from.cast<double>();
    const Vec3d span = to.cast<double>() - start;
    const double share = seen.clear ? 1.0 : seen.free_length / span.norm();
    const double exact = sampled_clearance(freespace, start, start + share * span, 8.0);
    EXPECT_LE(seen.clearance, exact + 1e-6 * (1.0 + freespace.bounds().diagonal().norm()));
    if (!seen.clear) return;
    EXPECT_GT(seen.clearance, 0.0F);
    EXPECT_GE(seen.clearance, radius * (1.0F - 1e-6F));
}

TEST(Sight, IsNeverWrongOverRandomMeshes) {
    int clear = 0;
    for (unsigned seed = 1; seed <= 6; ++seed) {
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        std::mt19937 random(seed);
        const Freespace freespace = make_freespace(random_contents(random, 8, 8, 25));
        for (int i = 0; i < 16; ++i) {
            const Vec3f from = covered_point(random, freespace);
            const Vec3f to = covered_point(random, freespace);
            const float radius = i % 2 == 0 ? 0.0F : 4.0F;
            const Sight seen = sight(freespace, from, to, radius);
            expect_safe(freespace, seen, from, to, radius);
            clear += seen.clear ? 1 : 0;
        }
    }
    EXPECT_GT(clear, 10) << "the meshes must let something be seen";
}

TEST(Sight, SeesWhatTheSlabsCover) {
    std::mt19937 random(11);
    const Freespace freespace = make_freespace(random_contents(random, 14, 14, 0));
    int visible = 0;
    int missed = 0;
    while (visible < 150) {
        const Vec3f from = covered_point(random, freespace);
        const Vec3f to = covered_point(random, freespace);
        double smallest = 1.0;
        for (int k = 0; k <= 64 && smallest > 0.5; ++k) {
            const Vec3f between = from + (to - from) * static_cast<float>(k) / 64.0F;
            smallest = std::min<double>(smallest, distance(freespace, between).value);
        }
        if (smallest <= 0.5) continue;
        ++visible;
        missed += sight(freespace, from, to).clear ? 0 : 1;
    }
    EXPECT_EQ(missed, 0) << "of " << visible;
}

// Where more room is left than a march needs to go on, it goes on.
TEST(Sight, IsAsLongAsTheTwinSays) {
    constexpr double room = 0.7;  // more than 1 % of the largest free distance
    int compared = 0;
    for (unsigned seed = 1; seed <= 6; ++seed) {
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        std::mt19937 random(seed);
        const Freespace freespace = make_freespace(random_contents(random, 10, 10, 30));
        for (int i = 0; i < 10; ++i) {
            const Vec3f from = covered_point(random, freespace);
            const Vec3f to = covered_point(random, freespace);
            const float radius = i % 2 == 0 ? 0.0F : 4.0F;
            const double expected =
                test::exact_free_length(freespace, from.cast<double>(), to.cast<double>(), radius, room);
            const Sight seen = sight(freespace, from, to, radius);
            ASSERT_GE(seen.free_length, expected * (1.0 - 1e-6))
                << from.transpose() << ", " << to.transpose();
            ASSERT_TRUE(seen.clear || expected < (to - from).norm());
            compared += expected > 0.0 ? 1 : 0;
        }
    }
    EXPECT_GT(compared, 30);
}

std::vector<Vec3f> centres(const RecentBalls& balls) {
    std::vector<Vec3f> all;
    for (std::size_t i = 0; i < RecentBalls::capacity; ++i)
        all.push_back(balls.ball(i).centre.cast<float>());
    return all;
}

TEST(RecentBalls, ProveTheSameSightAgainAlone) {
    const Freespace freespace = make_freespace(square_contents());
    RecentBalls recent;
    const Vec3f from(-20, 50, 5);
    EXPECT_TRUE(sight(freespace, from, {120, 50, 5}, 2.0F, recent).clear);
    const auto found = centres(recent);
    EXPECT_GT(recent.ball(0).radius, 0.0);
    EXPECT_TRUE(sight(freespace, from, {120, 50, 5}, 2.0F, recent).clear);
    EXPECT_TRUE(sight(freespace, from, {115, 51, 4}, 2.0F, recent).clear);
    EXPECT_EQ(centres(recent), found) << "no other ball was needed";
}

struct BallOnX {
    float x, radius;
};

// A map of slabs that are nearly balls.
Freespace balls_in_a_row(const std::vector<BallOnX>& balls) {
    Contents contents = test::empty_contents();
    for (const auto& [x, radius] : balls) {
        const auto first = static_cast<std::uint32_t>(contents.vertices.size());
        for (const float side : {-0.1F, 0.0F, 0.1F})
            contents.vertices.push_back({x, side, 10.0F * side * side, radius});
        contents.triangles.push_back({first, first + 1, first + 2});
    }
    return make_freespace(contents);
}

// A small ball that is worth a hop by itself, but gains too little after a large one, ends no sight that
// another ball carries on.
TEST(RecentBalls, EndNoSightThatTheOctreeCarriesOn) {
    const Freespace freespace = balls_in_a_row({{0, 100}, {150, 100}});
    RecentBalls recent;
    recent.add({{88.0, 0.0, 0.0}, 19.0}, 0);
    EXPECT_TRUE(sight(freespace, {0, 0, 0}, {240, 0, 0}, 0.0F, recent).clear);
}

TEST(RecentBalls, EndASightWhereNoBallGainsATenthButIsClearGoesOn) {
    const Freespace freespace = balls_in_a_row({{0, 100}, {10, 95}, {151, 50}});
    RecentBalls recent;
    const Vec3f from(-90, 0, 0);
    EXPECT_FALSE(sight(freespace, from, {190, 0, 0}, 0.0F, recent).clear);
    EXPECT_TRUE(is_clear(freespace, from, {190, 0, 0}, 0.0F, recent));
    EXPECT_FALSE(is_clear(freespace, from, {210, 0, 0}, 0.0F, recent));
}

TEST(RecentBalls, LeaveStrangeInputBlocked) {
    const Freespace freespace = make_freespace(square_contents());
    const Vec3f inside(50, 50, 0);
    RecentBalls recent;
    EXPECT_TRUE(sight(freespace, inside, inside, 0.0F, recent).clear);
    for (const float strange : {NAN, INFINITY, -INFINITY}) {
        EXPECT_FALSE(sight(freespace, inside, {50, strange, 0}, 0.0F, recent).clear);
        EXPECT_FALSE(sight(freespace, {strange, 50, 0}, inside, 0.0F, recent).clear);
        EXPECT_FALSE(sight(freespace, inside, inside, std::abs(strange), recent).clear);
    }
    EXPECT_FALSE(sight(freespace, inside, inside, -1.0F, recent).clear);
}

// Sights as a planner asks for them, from a point that moves: never wrong, and as long as the twin says.
TEST(RecentBalls, ShortenNoSightWithRoomAndAreNeverWrong) {
    constexpr double room = 7.0;  // more than 10 % of the largest free distance
    int compared = 0;
    int clear = 0;
    for (unsigned seed = 1; seed <= 6; ++seed) {
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        std::mt19937 random(seed);
        const Freespace freespace = make_freespace(random_contents(random, 10, 10, 30));
        RecentBalls recent;
        for (int i = 0; i < 4; ++i) {
            const Vec3f start = covered_point(random, freespace);
            const Vec3f way = covered_point(random, freespace) - start;
            for (int step = 0; step < 6; ++step) {
                const Vec3f from = start + static_cast<float>(step) / 30.0F * way;
                const Vec3f to = from + way;
                const float radius = i % 2 == 0 ? 0.0F : 4.0F;
                const Sight seen = sight(freespace, from, to, radius, recent);
                expect_safe(freespace, seen, from, to, radius);
                const double expected =
                    test::exact_free_length(freespace, from.cast<double>(), to.cast<double>(), radius, room);
                ASSERT_GE(seen.free_length, expected * (1.0 - 1e-6))
                    << from.transpose() << ", " << to.transpose();
                ASSERT_TRUE(seen.clear || expected < (to - from).norm());
                compared += expected > 0.0 ? 1 : 0;
                clear += seen.clear ? 1 : 0;
            }
        }
    }
    EXPECT_GT(compared, 30);
    EXPECT_GT(clear, 10);
}

TEST(SightOrigin, OfStrangeInputSeesNothing) {
    const Freespace freespace = make_freespace(square_contents());
    const Vec3f end(60, 50, 0);
    EXPECT_FALSE(SightOrigin(freespace, {NAN, 0, 0}, 0.0F).to(end).clear);
    EXPECT_FALSE(SightOrigin(freespace, {50, 50, 0}, -1.0F).to(end).clear);
    EXPECT_FALSE(SightOrigin(freespace, {50, 50, 0}, NAN).to(end).clear);
    EXPECT_TRUE(SightOrigin(freespace, {50, 50, 0}, 0.0F).to(end).clear);
}

// Large balls that nearly touch an oblique plane, as above open ground: near the plane the boxes of the index
// rule out few of them.
Contents open_ground(std::mt19937& random) {
    const auto uniform = [&](float low, float high) {
        return std::uniform_real_distribution<float>(low, high)(random);
    };
    const Vec3f normal = Vec3f(1, 2, 3).normalized();
    Contents contents = test::empty_contents();
    for (std::uint32_t i = 0; i < 3'000; ++i) {
        const Vec3f middle(uniform(-600, 600), uniform(-600, 600), uniform(0, 1'200));
        for (int corner = 0; corner < 3; ++corner) {
            const Vec3f p = middle + Vec3f(uniform(-60, 60), uniform(-60, 60), uniform(-60, 60));
            contents.vertices.push_back({p.x(), p.y(), p.z(), normal.dot(p) - uniform(1, 40)});
        }
        contents.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    return contents;
}

Vec3f random_direction(std::mt19937& random) {
    std::normal_distribution<float> normal;
    return Vec3f(normal(random), normal(random), normal(random)).normalized();
}

TEST(Sight, NeverFailsAtAStartWithRoom) {
    std::mt19937 random(13);
    for (const Contents& contents : {open_ground(random), random_contents(random, 14, 14, 200)}) {
        const Freespace freespace = make_freespace(contents);
        const float tolerance = 1e-5F * freespace.bounds().diagonal().norm();
        for (int i = 0; i < 400;) {
            const Vec3f from = covered_point(random, freespace);
            const float free_distance = distance(freespace, from).value;
            const float radius = free_distance * static_cast<float>(random() % 100) / 100.0F;
            if (free_distance > 100.0F || free_distance - radius < tolerance) continue;
            ++i;
            const Vec3f to = from + 120.0F * random_direction(random);
            ASSERT_GT(sight(freespace, from, to, radius).free_length, 0.0F)
                << from.transpose() << ", radius " << radius << " of " << free_distance;
        }
    }
}

TEST(Sight, DoesNotDependOnWhereTheOriginIs) {
    const Vec3f far(1 << 20, -(1 << 20), 1 << 18);
    Contents contents = square_contents();
    const Freespace near = make_freespace(contents);
    for (Vertex& vertex : contents.vertices)
        vertex = {vertex.x + far.x(), vertex.y + far.y(), vertex.z + far.z(), vertex.free_distance};
    const Freespace moved = make_freespace(contents);
    const Sight here = sight(near, {-20, 50, 5}, {120, 50, 5});
    const Sight there = sight(moved, Vec3f(-20, 50, 5) + far, Vec3f(120, 50, 5) + far);
    EXPECT_EQ(here.clear, there.clear);
    EXPECT_NEAR(here.clearance, there.clearance, 0.5F);
}

}  // namespace
}  // namespace camdir::freespace
