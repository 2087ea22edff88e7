#include "freespace/lookouts.hpp"

#include <gtest/gtest.h>

#include "freespace/distance.hpp"
#include "freespace/visibility.hpp"
#include "support/plan.hpp"

namespace camdir::freespace {
namespace {

TEST(Lookouts, AreRoomyAndSpread) {
    const Freespace freespace = test::l_corridor().freespace();
    const auto positions = freespace.lookouts().positions();
    ASSERT_GT(positions.size(), 4U);
    for (std::size_t i = 0; i < positions.size(); ++i) {
        EXPECT_GE(distance(freespace, positions[i]).value, 8.0F);
        for (std::size_t j = 0; j < i; ++j)
            EXPECT_GE((positions[i] - positions[j]).norm(), 40.0F);
    }
}

TEST(Lookouts, AreSpreadWiderWhereThereWouldBeTooMany) {
    const std::vector<std::string> rows(60, '#' + std::string(58, '.') + '#');
    std::vector<std::string> hall = rows;
    hall.front() = hall.back() = std::string(60, '#');
    const Freespace freespace = test::Plan(hall).freespace();
    const Lookouts& lookouts = freespace.lookouts();
    EXPECT_LE(lookouts.positions().size(), Lookouts::limit);
    EXPECT_GT(lookouts.positions().size(), Lookouts::limit / 3);
    EXPECT_GT(lookouts.reach(), 120.0F);
}

TEST(Lookouts, SeeEachOtherAsSightsDo) {
    const Freespace freespace = test::l_corridor().freespace();
    const Lookouts& lookouts = freespace.lookouts();
    const auto positions = lookouts.positions();
    std::size_t hidden = 0;
    for (std::uint32_t i = 0; i < positions.size(); ++i) {
        const Lookouts::Set& seen = lookouts.seen_from(freespace, i);
        for (std::uint32_t j = 0; j < positions.size(); ++j) {
            EXPECT_EQ(seen.test(j), i == j || sight(freespace, positions[i], positions[j]).clear);
            hidden += !seen.test(j);
        }
        EXPECT_LE(seen.count(), positions.size());
    }
    EXPECT_GT(hidden, 0U) << "there is a corner";
}

TEST(Lookouts, ThoseOfAPointAreTheNearestThatItSees) {
    const test::Plan plan = test::l_corridor();
    const Freespace freespace = plan.freespace();
    const Lookouts& lookouts = freespace.lookouts();
    const Vec3f eye = plan.eye('s');
    const auto nearest = lookouts.nearest(freespace, eye);
    ASSERT_GT(nearest.count, 0U);
    float last = 0.0F;
    Lookouts::Set seeing;
    for (const std::uint32_t lookout : nearest.span()) {
        const Vec3f& position = lookouts.positions()[lookout];
        EXPECT_TRUE(plan.segment_clear(eye, position));
        EXPECT_GE((position - eye).norm(), last);
        last = (position - eye).norm();
        seeing |= lookouts.seen_from(freespace, lookout);
    }
    EXPECT_EQ(lookouts.seeing(freespace, eye), seeing);
    EXPECT_EQ(lookouts.nearest(freespace, Vec3f(1e6F, 0.0F, 0.0F)).count, 0U);
}

TEST(Lookouts, ThoseAroundAPointAreSeenByItsNearest) {
    const test::Plan plan = test::l_corridor();
    const Freespace freespace = plan.freespace();
    const Lookouts& lookouts = freespace.lookouts();
    const Vec3f eye = plan.eye('s');
    const Lookouts::Set& seen = lookouts.seen_from(freespace, lookouts.nearest(freespace, eye).lookouts[0]);
    for (const float radius : {0.0F, 150.0F, 400.0F}) {
        const Lookouts::Set around = lookouts.around(freespace, eye, radius);
        for (std::uint32_t i = 0; i < lookouts.positions().size(); ++i)
            EXPECT_EQ(around.test(i), seen.test(i) && (lookouts.positions()[i] - eye).norm() <= radius);
    }
    EXPECT_TRUE(lookouts.around(freespace, eye, 400.0F).any());
    EXPECT_TRUE(lookouts.around(freespace, Vec3f(1e6F, 0.0F, 0.0F), 1e9F).none());
}

}  // namespace
}  // namespace camdir::freespace
