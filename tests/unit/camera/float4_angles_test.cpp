// Angles four at a time, against those of the C library.
#include "camera/float4_angles.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "camera/view.hpp"

namespace camdir::camera {
namespace {

constexpr double error = 4e-7;
constexpr float half_turn = std::numbers::pi_v<float>;

TEST(Float4Angles, SinesAndCosinesAreExactWithinTheirError) {
    const auto expect_exact = [](float angle) {
        const SineCosine found = sine_cosine(broadcast(angle));
        for (int k = 0; k < lane_count; ++k) {
            ASSERT_NEAR(found.sine[k], std::sin(static_cast<double>(angle)), error) << angle;
            ASSERT_NEAR(found.cosine[k], std::cos(static_cast<double>(angle)), error) << angle;
        }
    };
    for (int i = -100; i <= 100; ++i)
        for (const float beside : {-1e-3F, 0.0F, 1e-3F})
            expect_exact(static_cast<float>(i) * 0.25F * half_turn + beside);
    std::mt19937 random(1);
    std::uniform_real_distribution<float> angles(-200.0F, 200.0F);
    for (int i = 0; i < 100000; ++i)
        expect_exact(angles(random));
}

TEST(Float4Angles, ArcTangentsAreExactWithinTheirError) {
    const auto expect_exact = [](float y, float x) {
        const Float4 found = arc_tangent(broadcast(y), broadcast(x));
        for (int k = 0; k < lane_count; ++k)
            ASSERT_NEAR(found[k], std::atan2(static_cast<double>(y), static_cast<double>(x)), error)
                << y << ' ' << x;
    };
    for (const float y : {-3.0F, 0.0F, 3.0F})
        for (const float x : {-3.0F, 0.0F, 3.0F})
            expect_exact(y, x);
    std::mt19937 random(2);
    std::normal_distribution<float> normal;
    for (int i = 0; i < 100000; ++i)
        expect_exact(normal(random), std::exp(5.0F * normal(random)) * normal(random));
}

TEST(Float4Angles, DirectionsAreThoseOfLooks) {
    const Look looks[lane_count] = {{0.0F, 0.0F}, {2.0F, 1.0F}, {-3.0F, -1.5F}, {40.0F, 0.5F}};
    const Directions found =
        directions_of(Float4{looks[0].yaw, looks[1].yaw, looks[2].yaw, looks[3].yaw},
                      Float4{looks[0].pitch, looks[1].pitch, looks[2].pitch, looks[3].pitch});
    for (int k = 0; k < lane_count; ++k) {
        const Vec3f expected = direction_of(looks[k]);
        EXPECT_NEAR((Vec3f(found.x[k], found.y[k], found.z[k]) - expected).norm(), 0.0F, 1e-6F);
    }
}

}  // namespace
}  // namespace camdir::camera
