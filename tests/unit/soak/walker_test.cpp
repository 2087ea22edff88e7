#include "soak/walker.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "freespace/distance.hpp"
#include "support/freespace_meshes.hpp"

namespace camdir::soak {
namespace {

constexpr double dt = 1.0 / 60.0;
constexpr float clearance = 4.0F;

freespace::Freespace map() {
    std::mt19937 random(3);
    return test::make_freespace(test::random_contents(random, 12, 12, 0));
}

PoseArrays walked(Walker& walker, int steps) {
    PoseArrays poses;
    for (int i = 0; i < steps; ++i)
        walker.step(7, dt, poses);
    return poses;
}

TEST(Walker, StaysInFreespaceAndKeepsItsSpeedBetweenDeclaredJumps) {
    const freespace::Freespace freespace = map();
    const Roads roads(freespace, clearance);
    ASSERT_FALSE(roads.empty());
    const WalkStyle style{.speed = 300.0F, .stops_per_s = 0.2, .teleports_per_s = 0.1};
    Walker walker(roads, style, 11);
    const PoseArrays poses = walked(walker, 6000);
    int jumps = 0;
    float way = 0.0F;
    for (std::size_t i = 0; i < 6000; ++i) {
        const Vec3f eye(&poses.eye[3 * i]);
        const Eigen::Vector4f view(&poses.orientation[4 * i]);
        ASSERT_GE(freespace::distance(freespace, eye).value, 0.99F * clearance) << i;
        ASSERT_NEAR(view.norm(), 1.0F, 1e-4F);
        ASSERT_EQ(poses.player_id[i], 7U);
        if ((poses.flags[i] & 2U) != 0) {
            ++jumps;
        } else {
            const float step = (eye - Vec3f(&poses.eye[3 * i - 3])).norm();
            ASSERT_LE(step, 300.0F * 1.001F * static_cast<float>(dt)) << i;
            way += step;
        }
    }
    EXPECT_EQ(poses.flags[0], 3U) << "the first pose is a discontinuity";
    EXPECT_GT(jumps, 1);
    EXPECT_GT(way, 3000.0F) << "it does not stand still";
}

TEST(Walker, TurnsSmoothly) {
    const freespace::Freespace freespace = map();
    const Roads roads(freespace, clearance);
    Walker walker(roads, {.teleports_per_s = 0.0}, 5);
    const PoseArrays poses = walked(walker, 3000);
    for (std::size_t i = 1; i < 3000; ++i) {
        const Quatf before(&poses.orientation[4 * i - 4]);
        const Quatf now(&poses.orientation[4 * i]);
        // At most 6 degrees of yaw and 6 of pitch per frame.
        ASSERT_LE(before.angularDistance(now), 2.0F * 0.1048F) << i;
    }
}

TEST(Walker, TheSameSeedWalksTheSameWay) {
    const freespace::Freespace freespace = map();
    const Roads roads(freespace, clearance);
    Walker first(roads, {}, 1), again(roads, {}, 1), other(roads, {}, 2);
    const PoseArrays poses = walked(first, 600);
    EXPECT_EQ(poses.eye, walked(again, 600).eye);
    EXPECT_NE(poses.eye, walked(other, 600).eye);
}

TEST(Roads, EmptyWhereNothingIsWideEnough) {
    EXPECT_TRUE(Roads(map(), 1e6F).empty());
    EXPECT_TRUE(Roads(test::make_freespace(test::empty_contents()), 1.0F).empty());
}

}  // namespace
}  // namespace camdir::soak
