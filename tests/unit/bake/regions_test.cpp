#include "bake/reduction/regions.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

namespace camdir::bake {
namespace {

TEST(Regions, HoldEveryVertexOnceInListsOfLimitedSize) {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> unit(0.0F, 1.0F);
    std::vector<Vec3f> positions(5000);
    for (Vec3f& p : positions)
        p = {1000.0F * unit(random), 300.0F * unit(random), std::floor(4.0F * unit(random))};
    std::vector<std::uint32_t> chosen(4321);
    std::iota(chosen.begin(), chosen.end(), 100U);

    for (const double cut : {0.5, 0.36, 0.61}) {
        std::vector<std::uint32_t> all;
        for (const auto& region : make_regions(positions, chosen, 300, cut)) {
            EXPECT_LE(region.size(), 300U);
            EXPECT_TRUE(std::is_sorted(region.begin(), region.end()));
            all.insert(all.end(), region.begin(), region.end());
        }
        std::sort(all.begin(), all.end());
        EXPECT_EQ(all, chosen);
    }
}

TEST(Regions, OfNothingAreOneEmptyList) {
    const auto regions = make_regions({}, {}, 10, 0.5);
    ASSERT_EQ(regions.size(), 1U);
    EXPECT_TRUE(regions.front().empty());
}

}  // namespace
}  // namespace camdir::bake
