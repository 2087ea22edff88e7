// Polygons and welding.
#include <gtest/gtest.h>

#include <random>

#include "scene/bsp/polygon.hpp"
#include "scene/triangle_welder.hpp"
#include "support/q3_maps.hpp"

namespace camdir::scene {
namespace {

const Box3d unit(Vec3d::Constant(-1.0), Vec3d::Constant(1.0));

double area_of(const Polygon& polygon) {
    Vec3d sum = Vec3d::Zero();
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        sum += polygon[i].cross(polygon[(i + 1) % polygon.size()]);
    }
    return sum.norm() / 2.0;
}

Plane random_plane(std::mt19937& random) {
    return {test::random_point_in(random, unit).normalized(), test::random_point_in(random, unit).x()};
}

TEST(Polygon, BaseWindingLiesOnItsPlaneAndFacesItsNormal) {
    std::mt19937 random(1);
    for (int i = 0; i < 100; ++i) {
        const Plane plane = random_plane(random);
        const Polygon square = base_winding(plane, 10.0);
        EXPECT_TRUE(lies_on(square, plane, 1e-9));
        EXPECT_NEAR(area_of(square), 400.0, 1e-6);
        EXPECT_GT((square[1] - square[0]).cross(square[2] - square[1]).dot(plane.normal), 0.0);
    }
}

TEST(Polygon, ClipsPartitionTheArea) {
    std::mt19937 random(2);
    for (int i = 0; i < 1000; ++i) {
        const Polygon square = base_winding(random_plane(random), 2.0);
        const Plane knife = random_plane(random);
        const Polygon behind = clip(square, knife, 0.0);
        const Polygon before = clip(square, {-knife.normal, -knife.distance}, 0.0);
        EXPECT_NEAR(area_of(behind) + area_of(before), area_of(square), 1e-9);
        for (const Vec3d& corner : behind) {
            EXPECT_LE(knife.normal.dot(corner), knife.distance + 1e-9);
        }
    }
}

TEST(Polygon, ClipToBoxKeepsWhatIsInside) {
    const Polygon square = base_winding({Vec3d::UnitZ(), 0.5}, 10.0);
    EXPECT_NEAR(area_of(clip_to_box(square, unit)), 4.0, 1e-12);
    EXPECT_TRUE(clip_to_box(base_winding({Vec3d::UnitZ(), 1.5}, 10.0), unit).empty());
}

TEST(Polygon, TrianglesCoverTheArea) {
    std::mt19937 random(3);
    for (int i = 0; i < 200; ++i) {
        Polygon polygon = base_winding(random_plane(random), 2.0);
        for (int cut = 0; cut < 6; ++cut) {
            polygon = clip(polygon, random_plane(random), 0.0);
        }
        double sum = 0.0;
        for (const auto& [a, b, c] : triangulate(polygon)) {
            sum += area_of({polygon[a], polygon[b], polygon[c]});
        }
        EXPECT_NEAR(sum, area_of(polygon), 1e-9);
    }
}

TEST(TriangleWelder, NearCornersBecomeOneAndFlatTrianglesVanish) {
    TriangleWelder welder(0.01);
    EXPECT_TRUE(welder.add({0, 0, 0}, {1, 0, 0}, {0, 1, 0}));
    EXPECT_TRUE(welder.add({1.004, 0, 0}, {0, 0.996, 0}, {1, 1, 0}));
    EXPECT_FALSE(welder.add({0, 1, 0}, {0, 0, 0.004}, {1, 0, 0})) << "is there already";
    EXPECT_FALSE(welder.add({0, 0, 0}, {0.5, 0.00001, 0}, {1, 0, 0})) << "flat";
    EXPECT_FALSE(welder.add({0, 0, 0}, {0.005, 0, 0}, {0, 1, 0})) << "two corners are one";
    EXPECT_EQ(welder.take_triangles().size(), 2U);
}

TEST(TriangleWelder, NoTwoVerticesStayWithinTheTolerance) {
    std::mt19937 random(4);
    TriangleWelder welder(0.1);
    for (int i = 0; i < 2000; ++i) {
        welder.add(test::random_point_in(random, unit), test::random_point_in(random, unit),
                   test::random_point_in(random, unit));
    }
    const std::vector<Vec3d> vertices = welder.take_vertices();
    ASSERT_GT(vertices.size(), 100U);
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            ASSERT_GT((vertices[i] - vertices[j]).norm(), 0.1);
        }
    }
}

}  // namespace
}  // namespace camdir::scene
