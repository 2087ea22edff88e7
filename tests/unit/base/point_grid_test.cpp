#include "base/point_grid.hpp"

#include <gtest/gtest.h>

#include <random>

namespace camdir {
namespace {

TEST(PointGrid, FindsTheFirstPointWithinADistance) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> coordinate(-6.0, 6.0);
    const auto point = [&] { return Vec3d(coordinate(random), coordinate(random), coordinate(random)); };
    for (const double pitch : {0.7, 2.0, 50.0}) {
        PointGrid grid(pitch);
        for (std::uint32_t i = 0; i < 500; ++i)
            EXPECT_EQ(grid.add(point()), i);
        for (int round = 0; round < 500; ++round) {
            const Vec3d from = point();
            const double distance = 0.1 + 0.002 * round;
            std::uint32_t first = 0;
            while (first < 500 && (grid.points()[first] - from).norm() > distance)
                ++first;
            ASSERT_EQ(grid.first_within(from, distance), first) << "pitch " << pitch << " round " << round;
        }
    }
}

}  // namespace
}  // namespace camdir
