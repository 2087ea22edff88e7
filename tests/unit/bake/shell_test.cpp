#include "bake/shell.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace camdir::bake {
namespace {

const Box3d bounds(Vec3d(-100, 20, 0), Vec3d(900, 320, 50));

TEST(Shell, LiesOnABoxAroundTheBounds) {
    for (const Vec3d& sample : shell_samples(bounds, 64.0)) {
        const Vec3d below = (sample - bounds.min()).cwiseMin(bounds.max() - sample);
        EXPECT_NEAR(below.minCoeff(), -64.0, 1e-9);
    }
}

TEST(Shell, HasASampleNearEveryPointOfTheBox) {
    constexpr double spacing = 64.0;
    const std::vector<Vec3d> samples = shell_samples(bounds, spacing);
    const Vec3d low = bounds.min() - Vec3d::Constant(spacing);
    const Vec3d size = bounds.sizes() + Vec3d::Constant(2.0 * spacing);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (int i = 0; i < 1000; ++i) {
        Vec3d p = low + size.cwiseProduct(Vec3d(unit(random), unit(random), unit(random)));
        const int axis = i % 3;
        p[axis] = low[axis] + (i % 2) * size[axis];
        double nearest = std::numeric_limits<double>::infinity();
        for (const Vec3d& sample : samples)
            nearest = std::min(nearest, (sample - p).norm());
        EXPECT_LE(nearest, spacing * std::sqrt(0.5) + 1e-9) << p.transpose();
    }
}

TEST(Shell, OfALargeMapHasNoMoreSamplesThanThatOfASmallOne) {
    const Box3d vast(Vec3d::Constant(-1e5), Vec3d::Constant(1e5));
    EXPECT_EQ(shell_spacing(bounds, 16.0), 64.0);
    EXPECT_LT(shell_samples(vast, shell_spacing(vast, 2.0)).size(), 30'000U);
}

}  // namespace
}  // namespace camdir::bake
