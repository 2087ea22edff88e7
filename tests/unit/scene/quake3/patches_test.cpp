#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

#include "scene/quake3/patches.hpp"
#include "support/oracle_twins.hpp"
#include "support/q3_maps.hpp"

namespace camdir::scene::q3 {
namespace {

constexpr std::size_t unlimited = 1'000'000;

Tessellation tessellated(const Bsp& bsp) {
    return tessellate(bsp, bsp.faces.front(), unlimited).value();
}

Bsp patch_map(int width, int height, const std::vector<Vec3d>& points) {
    Bsp bsp = test::empty_map();
    test::add_patch(bsp, width, height, points, test::stone);
    return bsp;
}

// De Casteljau's construction, over the whole patch: u in 0 .. spans across, v in 0 .. spans down.
Vec3d on_surface(const std::vector<Vec3d>& points, int width, int height, double u, double v) {
    const auto curve = [](const Vec3d& a, const Vec3d& b, const Vec3d& c, double t) {
        const Vec3d first = a + t * (b - a);
        const Vec3d second = b + t * (c - b);
        return Vec3d(first + t * (second - first));
    };
    const int i = std::min(static_cast<int>(u), width / 2 - 1);
    const int j = std::min(static_cast<int>(v), height / 2 - 1);
    const auto row = [&](int r) {
        const auto first = static_cast<std::size_t>((2 * j + r) * width + 2 * i);
        return curve(points[first], points[first + 1], points[first + 2], u - i);
    };
    return curve(row(0), row(1), row(2), v - j);
}

TEST(Patch, FlatPatchIsTwoTriangles) {
    std::vector<Vec3d> points;
    for (int y = 0; y < 3; ++y) {
        for (int x = 0; x < 3; ++x) {
            points.emplace_back(100.0 * x, 100.0 * y, 7.0);
        }
    }
    EXPECT_EQ(tessellated(patch_map(3, 3, points)).triangles().size(), 2U);
}

TEST(Patch, TrianglesStayWithinAUnitOfTheSurface) {
    const unsigned seed = 11;
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    for (int round = 0; round < 40; ++round) {
        const double scale = round % 2 == 0 ? 20.0 : 150.0;
        const Box3d box(Vec3d::Constant(-scale), Vec3d::Constant(scale));
        std::vector<Vec3d> points;
        for (int i = 0; i < 15; ++i) {
            const int row = i / 5;
            points.push_back(Vec3d(200.0 * (i % 5), 200.0 * row, 0.0) + test::random_point_in(random, box));
        }
        const auto triangles = tessellated(patch_map(5, 3, points)).triangles();
        for (int sample = 0; sample < 60; ++sample) {
            const Vec3d at = test::random_point_in(random, Box3d(Vec3d::Zero(), Vec3d(2.0, 1.0, 0.0)));
            const Vec3d point = on_surface(points, 5, 3, at.x(), at.y());
            double distance = std::numeric_limits<double>::infinity();
            for (const auto& [a, b, c] : triangles) {
                const bool is_degenerate = (b - a).cross(c - a).norm() < 1e-9;
                if (!is_degenerate) distance = std::min(distance, test::distance_to_triangle(point, a, b, c));
            }
            ASSERT_LE(distance, 1.0) << "round " << round;
        }
    }
}

TEST(Patch, HugePatchIsRefusedByTheLimit) {
    std::vector<Vec3d> points(9, Vec3d::Zero());
    points[4] = Vec3d::Constant(1e6);
    points[1] = Vec3d(-1e6, 0.0, 1e6);
    const Bsp bsp = patch_map(3, 3, points);
    EXPECT_FALSE(tessellate(bsp, bsp.faces.front(), bsp.max_triangles()));
}

}  // namespace
}  // namespace camdir::scene::q3
