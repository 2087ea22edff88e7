#include "base/round_down.hpp"

#include <gtest/gtest.h>

#include <random>

namespace camdir {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

TEST(RoundDown, KeepsWhatAFloatHolds) {
    for (const float value :
         {0.0F, 1.0F, -2.5F, 1e-45F, std::numeric_limits<float>::max(), infinity, -infinity})
        EXPECT_EQ(round_down(value), value);
    EXPECT_TRUE(std::isnan(round_down(std::nan(""))));
}

TEST(RoundDown, IsTheLargestFloatThatIsNotAbove) {
    EXPECT_EQ(round_down(1e300), std::numeric_limits<float>::max());
    EXPECT_EQ(round_down(-1e-300), -std::numeric_limits<float>::denorm_min());
    std::mt19937 random(1);
    std::uniform_real_distribution<double> exponent(-50.0, 50.0);
    for (int i = 0; i < 10'000; ++i) {
        const double value = (i % 2 == 0 ? 1.0 : -1.0) * std::exp2(exponent(random));
        const float rounded = round_down(value);
        ASSERT_LE(double{rounded}, value);
        ASSERT_GT(double{std::nextafter(rounded, infinity)}, value);
    }
}

}  // namespace
}  // namespace camdir
