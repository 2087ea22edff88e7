#include "freespace/distance.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/freespace_meshes.hpp"
#include "support/freespace_twins.hpp"

namespace camdir::freespace {
namespace {

using test::covered_point;
using test::exact_distance;
using test::make_freespace;
using test::random_contents;
using test::random_point;
using test::square_contents;

// How far below the exact maximum the single-precision search may end, relative to the lengths involved.
double tolerance(const Freespace& freespace) {
    return 1e-5 * freespace.bounds().diagonal().norm();
}

TEST(Distance, OfPointsAroundASquare) {
    const Freespace freespace = make_freespace(square_contents());
    EXPECT_NEAR(distance(freespace, {50, 50, 10}).value, 30.0F, 1e-4F) << "above the middle";
    EXPECT_NEAR(distance(freespace, {130, 50, 0}).value, 10.0F, 1e-4F) << "beside an edge";
    EXPECT_NEAR(distance(freespace, {103, 104, 12}).value, 27.0F, 1e-4F) << "off a corner";
    EXPECT_FALSE(distance(freespace, {50, 50, 40.01F}).covered()) << "outside every slab";
}

TEST(Distance, SteeperThanOneIsTheBallOfTheHigherCorner) {
    Contents contents = test::empty_contents();
    contents.vertices = {{0, 0, 0, 50}, {10, 0, 0, 5}, {0, 10, 0, 5}};
    contents.triangles = {{0, 1, 2}};
    EXPECT_NEAR(distance(make_freespace(contents), {6, 8, 0}).value, 40.0F, 1e-4F);
}

TEST(Distance, NegativeCornersHoldNothing) {
    Contents contents = test::empty_contents();
    contents.vertices = {{0, 0, 0, -1}, {10, 0, 0, -1}, {0, 10, 0, -1}};
    contents.triangles = {{0, 1, 2}};
    EXPECT_FALSE(distance(make_freespace(contents), {1, 1, 0}).covered());
}

TEST(Distance, EmptyMeshAndStrangePointsAreUncovered) {
    const Freespace empty = make_freespace(test::empty_contents());
    EXPECT_EQ(distance(empty, Vec3f::Zero()).triangle, none);
    const Freespace freespace = make_freespace(square_contents());
    for (const float strange : {NAN, INFINITY, -INFINITY, 1e30F})
        EXPECT_FALSE(distance(freespace, Vec3f(50, strange, 0)).covered()) << strange;
}

TEST(Distance, IsTheExactMaximumOverRandomMeshes) {
    for (unsigned seed = 1; seed <= 8; ++seed) {
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        std::mt19937 random(seed);
        const Freespace freespace = make_freespace(random_contents(random, 12, 9, 60));
        for (int i = 0; i < 60; ++i) {
            const Vec3f point =
                i % 4 == 0 ? random_point(random, freespace) : covered_point(random, freespace);
            const double exact = exact_distance(freespace, point.cast<double>());
            const Distance found = distance(freespace, point);
            ASSERT_LE(found.value, exact + 1e-9) << point.transpose();
            if (exact <= tolerance(freespace)) continue;  // in no slab, or hardly
            ASSERT_GE(found.value, exact - tolerance(freespace)) << point.transpose();
            ASSERT_LE(found.value, test::slab_distance(freespace, found.triangle, point) + 1e-6);
        }
    }
}

TEST(Distance, StaysPreciseFarFromTheOrigin) {
    std::mt19937 random(7);
    const Freespace freespace =
        make_freespace(random_contents(random, 12, 9, 20, Vec3f(60'000, -50'000, 40'000)));
    for (int i = 0; i < 60; ++i) {
        const Vec3f point = covered_point(random, freespace);
        const double exact = exact_distance(freespace, point.cast<double>());
        const float found = distance(freespace, point).value;
        ASSERT_LE(found, exact + 1e-9);
        ASSERT_GE(found, exact > 1e-3 ? exact - 1e-3 : -INFINITY);
    }
}

}  // namespace
}  // namespace camdir::freespace
