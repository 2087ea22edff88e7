#include "bake/triangulate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace camdir::bake {
namespace {

// Corners on an ellipse in a random plane.
std::vector<Vec3d> random_convex(std::mt19937& random, std::size_t count) {
    std::uniform_real_distribution<double> angle(0.0, 2.0 * M_PI);
    std::normal_distribution<double> normal;
    std::vector<double> angles(count);
    for (double& a : angles)
        a = angle(random);
    std::sort(angles.begin(), angles.end());
    const Vec3d u = 30.0 * Vec3d(normal(random), normal(random), normal(random)).normalized();
    const Vec3d v = 10.0 * u.unitOrthogonal();
    std::vector<Vec3d> polygon;
    for (const double a : angles)
        polygon.push_back(std::cos(a) * u + std::sin(a) * v);
    return polygon;
}

double area(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
    return 0.5 * (b - a).cross(c - a).norm();
}

TEST(TriangulateConvex, CoversThePolygonWithItsDelaunayTriangles) {
    std::mt19937 random(12);
    for (int round = 0; round < 200; ++round) {
        const auto polygon = random_convex(random, 3 + random() % 12);
        std::vector<std::array<std::uint32_t, 3>> triangles;
        triangulate_convex(polygon, triangles);
        ASSERT_EQ(triangles.size(), polygon.size() - 2);
        double fan = 0.0;
        for (std::size_t i = 2; i < polygon.size(); ++i)
            fan += area(polygon[0], polygon[i - 1], polygon[i]);
        double sum = 0.0;
        for (const auto& [i, j, k] : triangles) {
            sum += area(polygon[i], polygon[j], polygon[k]);
            // No corner inside the circle through three others: seen from it, the far edge's angle is not
            // wider.
            for (const auto& [a, b, c] : {std::array{i, j, k}, std::array{j, k, i}, std::array{k, i, j}}) {
                const auto sees = [&, a = a, b = b](std::uint32_t from) {
                    const Vec3d to_a = (polygon[a] - polygon[from]).normalized();
                    const Vec3d to_b = (polygon[b] - polygon[from]).normalized();
                    return std::acos(std::clamp(to_a.dot(to_b), -1.0, 1.0));
                };
                for (std::uint32_t p = 0; p < polygon.size(); ++p) {
                    const bool beyond =
                        p != i && p != j && p != k &&
                        (polygon[b] - polygon[a])
                                .cross(polygon[p] - polygon[a])
                                .dot((polygon[b] - polygon[a]).cross(polygon[c] - polygon[a])) < 0.0;
                    ASSERT_TRUE(!beyond || sees(p) + sees(c) <= M_PI + 1e-6) << "round " << round;
                }
            }
        }
        ASSERT_NEAR(sum, fan, 1e-9 * fan) << "round " << round;
    }
}

TEST(Triangulate, DropsTrianglesWithoutArea) {
    VoronoiFaces faces;
    faces.vertices = {Vec3d(0, 0, 0), Vec3d(8, 0, 0), Vec3d(0, 8, 0), Vec3d(8, 1e-12, 0), Vec3d(4, 0, 0)};
    faces.corners = {0, 1, 2, 0, 1, 3, 0, 4, 1};
    faces.begin = {0, 3, 6, 9};
    Stage stage("triangulate", {}, {});
    const MedialMesh mesh = triangulate(faces, stage).value();
    EXPECT_EQ(mesh.vertices.size(), 5U);
    ASSERT_EQ(mesh.triangles.size(), 1U);
    EXPECT_EQ(mesh.triangles[0].c + mesh.triangles[0].b + mesh.triangles[0].a, 3U);
}

TEST(Triangulate, KeepsOneOfTrianglesWithTheSameCorners) {
    VoronoiFaces faces;
    faces.vertices = {Vec3d(0, 0, 0), Vec3d(8, 0, 0), Vec3d(0, 8, 0), Vec3d(0, 0, 8)};
    faces.corners = {0, 1, 2, 2, 1, 0, 0, 1, 3, 1, 2, 0};
    faces.begin = {0, 3, 6, 9, 12};
    Stage stage("triangulate", {}, {});
    const MedialMesh mesh = triangulate(faces, stage).value();
    ASSERT_EQ(mesh.triangles.size(), 2U);
    EXPECT_NE(mesh.triangles[0].c, 3U);
    EXPECT_EQ(mesh.triangles[1].a + mesh.triangles[1].b + mesh.triangles[1].c, 4U);
}

}  // namespace
}  // namespace camdir::bake
