#include "camera/group/framing.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace camdir::camera {
namespace {

TEST(Framing, APictureHoldsPointsThatAreNotTooFarApart) {
    const PictureShape shape = PictureShape::of(1.0F, 0.9F);
    const auto holds = [&](const std::vector<Vec3f>& points) {
        return fits_one_picture(Vec3f::Zero(), points, shape);
    };
    EXPECT_TRUE(holds({{100.0F, 0.0F, 0.0F}, {60.0F, 60.0F, 20.0F}}));
    EXPECT_FALSE(holds({{100.0F, 0.0F, 0.0F}, {0.0F, 100.0F, 0.0F}}));
    EXPECT_FALSE(holds({{100.0F, 0.0F, 0.0F}, {20.0F, 0.0F, 100.0F}}));
    EXPECT_TRUE(holds({{100.0F, 0.0F, 0.0F}}));
}

// Random points of a random look's picture.
TEST(Framing, APictureHoldsWhatSomeLookHolds) {
    const PictureShape shape = PictureShape::of(1.0F, 0.9F);
    std::mt19937 random(5);
    std::uniform_real_distribution<float> any(-1.0F, 1.0F);
    int refused = 0;
    for (int i = 0; i < 2000; ++i) {
        const Look look{3.0F * any(random), 0.9F * any(random)};
        const Vec3f forward = direction_of(look);
        const Vec3f right(std::sin(look.yaw), -std::cos(look.yaw), 0.0F);
        std::vector<Vec3f> points;
        for (int p = 0; p < 2 + i % 3; ++p) {
            const float x = 0.97F * shape.half_width * any(random);
            const float y = 0.97F * shape.half_height * any(random);
            points.emplace_back(300.0F * (1.1F + any(random)) *
                                (forward + x * right + y * right.cross(forward)));
        }
        ASSERT_TRUE(extent_of(Vec3f::Zero(), look, points)->within(shape));
        refused += fits_one_picture(Vec3f::Zero(), points, shape) ? 0 : 1;
    }
    EXPECT_LE(refused, 100) << "pictures whose middle is not the points' middle";
}

TEST(Framing, WhatFitsIsWhatCanBeLookedAt) {
    std::mt19937 random(7);
    std::normal_distribution<float> any(0.0F, 100.0F);
    int fitting = 0;
    for (int i = 0; i < 4000; ++i) {
        const PictureShape shape = PictureShape::of(0.4F + 0.5F * static_cast<float>(i % 5), 0.9F);
        std::vector<Vec3f> points;
        for (int p = 0; p < 1 + i % 4; ++p)
            points.emplace_back(any(random) + 100.0F, any(random), any(random));
        const bool fits = fits_one_picture(Vec3f::Zero(), points, shape);
        EXPECT_EQ(fits, look_at_all(Vec3f::Zero(), points, shape).has_value()) << i;
        fitting += fits ? 1 : 0;
    }
    EXPECT_GT(fitting, 500);
    EXPECT_LT(fitting, 3500);
    EXPECT_FALSE(fits_one_picture(Vec3f::Zero(), {}, PictureShape::of(1.0F, 0.9F)));
}

TEST(Framing, LooksAtAllFromTheMiddle) {
    const Vec3f points[] = {{100.0F, 60.0F, 0.0F}, {100.0F, -20.0F, 40.0F}, {300.0F, 10.0F, -30.0F}};
    const PictureShape shape = PictureShape::of(1.0F, 0.9F);
    const auto look = look_at_all(Vec3f::Zero(), points, shape);
    ASSERT_TRUE(look);
    const auto extent = extent_of(Vec3f::Zero(), *look, points);
    ASSERT_TRUE(extent);
    EXPECT_NEAR(extent->left, -extent->right, 1e-3F);
    EXPECT_NEAR(extent->bottom, -extent->top, 1e-3F);
    const Vec3f opposite[] = {{100.0F, 0.0F, 0.0F}, {-100.0F, 0.0F, 0.0F}};
    EXPECT_FALSE(look_at_all(Vec3f::Zero(), opposite, shape));
}

TEST(Framing, TurnsNoFurtherThanTheDeadZoneAsks) {
    const PictureShape zone = PictureShape::of(1.0F, 0.6F);
    const Look ahead{0.0F, 0.0F};
    const Vec3f inside[] = {{100.0F, 20.0F, 10.0F}};
    EXPECT_EQ(look_within(Vec3f::Zero(), ahead, inside, zone).yaw, 0.0F);
    const Vec3f outside[] = {{100.0F, 90.0F, 0.0F}};
    const Look turned = look_within(Vec3f::Zero(), ahead, outside, zone);
    const auto extent = extent_of(Vec3f::Zero(), turned, outside);
    ASSERT_TRUE(extent);
    EXPECT_NEAR(extent->left, -zone.half_width, 1e-3F) << "at its edge";
}

}  // namespace
}  // namespace camdir::camera
