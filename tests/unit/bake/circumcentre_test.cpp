#include "bake/geometry/circumcentre.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace camdir::bake {
namespace {

Vec3d on_sphere(std::mt19937& random, const Vec3d& centre, double radius) {
    std::normal_distribution<double> normal;
    return centre + radius * Vec3d(normal(random), normal(random), normal(random)).normalized();
}

TEST(Circumcentre, IsTheCentreOfTheSphereThroughThePoints) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> coordinate(-4000.0, 4000.0);
    std::uniform_real_distribution<double> size(1.0, 500.0);
    for (int round = 0; round < 2000; ++round) {
        const Vec3d centre(coordinate(random), coordinate(random), coordinate(random));
        const double radius = size(random);
        const std::array<Vec3d, 4> points{
            on_sphere(random, centre, radius), on_sphere(random, centre, radius),
            on_sphere(random, centre, radius), on_sphere(random, centre, radius)};
        const Vec3d found = circumcentre(points);
        for (const Vec3d& p : points)
            ASSERT_NEAR((found - p).norm(), (found - points[0]).norm(), 1e-5) << "round " << round;
    }
}

// Corners of a square on a floor, one lifted by the smallest step of a double: the formula in floating point
// loses every digit here.
TEST(Circumcentre, OfAlmostFlatTetrahedraIsRoundedFromTheExactOne) {
    const double base = 1024.0;
    const double lifted = std::nextafter(base, 2000.0);
    const std::array<Vec3d, 4> points{Vec3d(0, 0, base), Vec3d(16, 0, base), Vec3d(0, 16, base),
                                      Vec3d(16, 16, lifted)};
    const Vec3d centre = circumcentre(points);
    // Equidistant from the three in the floor, so at (8, 8, z); by hand z - base = (lift^2 + 0) / (2 lift).
    EXPECT_DOUBLE_EQ(centre.x(), 8.0);
    EXPECT_DOUBLE_EQ(centre.y(), 8.0);
    EXPECT_NEAR(centre.z(), base, 1e-12);
}

TEST(Circumcentre, OfAlmostFlatTetrahedraMayBeFarAway) {
    const std::array<Vec3d, 4> points{Vec3d(0, 0, 0), Vec3d(16, 0, 0), Vec3d(0, 16, 0), Vec3d(20, 20, 1e-6)};
    const Vec3d centre = circumcentre(points);
    // (8, 8, z) with 64 + 64 + z^2 = 144 + 144 + (z - h)^2, so z = (160 + h^2) / (2 h).
    EXPECT_NEAR(centre.z() / 8e7, 1.0, 1e-12);
    EXPECT_DOUBLE_EQ(centre.x(), 8.0);
}

}  // namespace
}  // namespace camdir::bake
