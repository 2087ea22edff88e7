#include "bake/shell.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace camdir::bake {
namespace {

const Box3d bounds(Vec3d(-100, 20, 0), Vec3d(900, 320, 50));
constexpr Shell around{64.0, 80.0};

TEST(Shell, LiesOnABoxAroundTheBounds) {
    const std::vector<Vec3d> samples = shell_samples(bounds, around);
    EXPECT_GT(samples.size(), 100U);
    for (const Vec3d& sample : samples)
        EXPECT_NEAR(depth_in(bounds, sample), -64.0, 1e-9);
}

TEST(Shell, HasASampleNearEveryPointOfTheBox) {
    const std::vector<Vec3d> samples = shell_samples(bounds, around);
    const Vec3d low = bounds.min() - Vec3d::Constant(around.distance);
    const Vec3d size = bounds.sizes() + Vec3d::Constant(2.0 * around.distance);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (int i = 0; i < 1000; ++i) {
        Vec3d p = low + size.cwiseProduct(Vec3d(unit(random), unit(random), unit(random)));
        const int axis = i % 3;
        p[axis] = low[axis] + (i % 2) * size[axis];
        double nearest = std::numeric_limits<double>::infinity();
        for (const Vec3d& sample : samples)
            nearest = std::min(nearest, (sample - p).norm());
        EXPECT_LE(nearest, around.spacing * std::sqrt(0.5) + 1e-9) << p.transpose();
    }
}

TEST(Shell, KeepsFurtherAwayThanSamplesOfTheMap) {
    EXPECT_EQ(shell_around(bounds, 16.0, 128.0).distance, 64.0);
    EXPECT_EQ(shell_around(bounds, 16.0, 1024.0).distance, 512.0);
    EXPECT_EQ(shell_around(bounds, 16.0, 128.0).spacing, 64.0);
}

TEST(Shell, HasALimitedNumberOfSamplesWhateverTheBox) {
    for (const Vec3d& size : {Vec3d(0, 0, 0), Vec3d(1e5, 0, 0), Vec3d(1e6, 1e6, 0), Vec3d(1e6, 1e6, 1e6),
                              Vec3d(1e6, 3e3, 10), Vec3d(1e4, 1e4, 1e4)}) {
        const Box3d box(Vec3d(-1, -2, -3), Vec3d(-1, -2, -3) + size);
        const auto samples = shell_samples(box, shell_around(box, 2.0, 16.0));
        EXPECT_GE(samples.size(), 8U) << size.transpose();
        EXPECT_LE(samples.size(), max_shell_samples) << size.transpose();
    }
}

}  // namespace
}  // namespace camdir::bake
