#include "freespace/shape_checks.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace camdir::freespace {
namespace {

Vec3f random_normal(std::mt19937& random) {
    std::normal_distribution<float> normal;
    return Vec3f(normal(random), normal(random), normal(random)).normalized();
}

// Tangent to the unit sphere about `centre` in random directions, with a box so that they are bounded.
std::vector<HalfSpace> random_hull(std::size_t count, const Vec3f& centre, std::mt19937& random) {
    std::vector<HalfSpace> hull;
    for (int axis = 0; axis < 3; ++axis) {
        hull.push_back({Vec3f::Unit(axis), centre[axis] + 2.0F});
        hull.push_back({-Vec3f::Unit(axis), -centre[axis] + 2.0F});
    }
    while (hull.size() < count) {
        const Vec3f normal = random_normal(random);
        hull.push_back({normal, normal.dot(centre) + 1.0F});
    }
    std::shuffle(hull.begin(), hull.end(), random);
    return hull;
}

// The slow, obvious twin: corners are where three planes meet and no other cuts off more than `tolerance`.
Box3d bounds_by_corners(const std::vector<HalfSpace>& hull, double tolerance) {
    Box3d bounds;
    for (std::size_t i = 0; i < hull.size(); ++i)
        for (std::size_t k = i + 1; k < hull.size(); ++k)
            for (std::size_t m = k + 1; m < hull.size(); ++m) {
                Eigen::Matrix3d normals;
                normals << hull[i].normal.cast<double>().transpose(),
                    hull[k].normal.cast<double>().transpose(), hull[m].normal.cast<double>().transpose();
                if (std::abs(normals.determinant()) < 1e-10) continue;
                const Vec3d corner =
                    normals.inverse() * Vec3d(hull[i].distance, hull[k].distance, hull[m].distance);
                if (std::ranges::all_of(hull, [&](const HalfSpace& space) {
                        return space.normal.cast<double>().dot(corner) <= space.distance + tolerance;
                    }))
                    bounds.extend(corner);
            }
    return bounds;
}

RC_GTEST_PROP(HullBounds, EncloseTheCornersClosely, (std::uint32_t seed)) {
    std::mt19937 random(seed);
    const Vec3f centre = 100.0F * random_normal(random);
    const auto hull = random_hull(6 + seed % 20, centre, random);
    const auto bounds = bounds_of(hull);
    RC_ASSERT(bounds.has_value());
    const Box3d found = bounds->cast<double>();
    RC_ASSERT(found.contains(bounds_by_corners(hull, 1e-9)));
    Box3d most = bounds_by_corners(hull, 1e-3);
    most.min().array() -= 0.01;
    most.max().array() += 0.01;
    RC_ASSERT(most.contains(found));
}

RC_GTEST_PROP(HullBounds, AreOfNoUnboundedHull, (std::uint32_t seed)) {
    std::mt19937 random(seed);
    const Vec3f open = random_normal(random);
    std::vector<HalfSpace> hull;
    while (hull.size() < 4 + seed % 20) {
        const Vec3f normal = random_normal(random);
        if (normal.dot(open) < 0.0F) hull.push_back({normal, 1.0F});
    }
    RC_ASSERT(!bounds_of(hull));
}

TEST(HullBounds, AreOfNoEmptyHull) {
    std::mt19937 random(1);
    auto hull = random_hull(20, Vec3f::Zero(), random);
    hull.push_back({Vec3f::UnitX(), -3.0F});
    EXPECT_FALSE(bounds_of(hull));
}

TEST(HullBounds, NeedFourHalfSpacesAndNoLineOfTwo) {
    const std::vector<HalfSpace> slab = {
        {Vec3f::UnitX(), 1.0F}, {-Vec3f::UnitX(), 1.0F}, {Vec3f::UnitX(), 2.0F}, {-Vec3f::UnitX(), 2.0F}};
    EXPECT_FALSE(bounds_of(slab));
    EXPECT_FALSE(bounds_of(std::span(slab).first(3)));
    EXPECT_FALSE(bounds_of({}));
}

TEST(HullBounds, AreOfNoHullThatReachesTooFar) {
    std::vector<HalfSpace> box;
    for (int axis = 0; axis < 3; ++axis) {
        box.push_back({Vec3f::Unit(axis), 1.0F});
        box.push_back({-Vec3f::Unit(axis), 1.0F});
    }
    EXPECT_TRUE(bounds_of(box));
    box[0].distance = 2e6F;
    EXPECT_FALSE(bounds_of(box));
}

TEST(Balls, HaveARadiusAndAPlace) {
    EXPECT_TRUE(is_ball({Vec3f(1.0F, -1e8F, 0.0F), 5.0F}));
    EXPECT_FALSE(is_ball({Vec3f(1.0F, -1e9F, 0.0F), 5.0F}));
    EXPECT_FALSE(is_ball({Vec3f(NAN, 0.0F, 0.0F), 5.0F}));
    EXPECT_FALSE(is_ball({Vec3f(0.0F, 0.0F, INFINITY), 5.0F}));
    for (const float radius : {0.0F, -1.0F, 1e9F, NAN})
        EXPECT_FALSE(is_ball({Vec3f::Zero(), radius})) << radius;
}

}  // namespace
}  // namespace camdir::freespace
