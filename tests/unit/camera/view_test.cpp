#include "camera/view.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

namespace camdir::camera {
namespace {

constexpr float pi = std::numbers::pi_v<float>;

TEST(View, LooksAlongTheDirectionWithALevelHorizon) {
    std::mt19937 random(11);
    std::normal_distribution<float> coordinate;
    for (int i = 0; i < 2000; ++i) {
        const Vec3f direction(coordinate(random), coordinate(random), coordinate(random));
        const Quatf orientation = orientation_of(look_along(direction, 0.3F));
        EXPECT_NEAR(angle_between(orientation * Vec3f::UnitX(), direction), 0.0F, 2e-3F);
        EXPECT_NEAR((orientation * Vec3f::UnitY()).z(), 0.0F, 1e-6F);
        EXPECT_GE((orientation * Vec3f::UnitZ()).z(), 0.0F);
    }
}

TEST(View, StraightUpAndDownKeepTheHeadingBefore) {
    for (const float z : {1.0F, -1.0F}) {
        const Quatf orientation = orientation_of(look_along({0.0F, 0.0F, z}, 0.7F));
        EXPECT_NEAR((orientation * Vec3f::UnitX()).z(), z, 1e-6F);
        EXPECT_TRUE((orientation * Vec3f::UnitY()).isApprox(direction_of({0.7F + pi / 2.0F, 0.0F}), 1e-5F));
    }
    const Look nowhere = look_along(Vec3f::Zero(), 0.7F);
    EXPECT_EQ(nowhere.yaw, 0.7F);
    EXPECT_EQ(nowhere.pitch, 0.0F);
}

TEST(View, TurnsTheShortWayRoundAndNoFasterThanTheLimit) {
    const Look from{0.9F * pi, 0.0F};
    const Look to{-0.9F * pi, 0.0F};
    EXPECT_NEAR(turned(from, to, 0.5F, 10.0F).yaw, pi, 1e-5F);
    EXPECT_NEAR(wrapped(turned(from, to, 1.0F, 0.1F).yaw - from.yaw), 0.1F, 1e-5F);
    const Look both = turned({0.0F, 0.0F}, {0.3F, 0.4F}, 1.0F, 0.25F);
    EXPECT_NEAR(std::hypot(both.yaw, both.pitch), 0.25F, 1e-6F);
}

}  // namespace
}  // namespace camdir::camera
