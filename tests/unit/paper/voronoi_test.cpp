#include "bench/paper/voronoi.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

#include "bake/triangulate.hpp"
#include "bench/paper/constant_distance.hpp"

namespace camdir::paper {
namespace {

constexpr double d0 = 3.0;
const Box3d bounds(Vec3d(-50.0, -50.0, -50.0), Vec3d(150.0, 150.0, 150.0));

std::vector<Vec3d> random_points(unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> coordinate(0.0, 100.0);
    std::vector<Vec3d> points(400);
    for (Vec3d& point : points)
        for (double& x : point)
            x = coordinate(random);
    return points;
}

// Generator distance and area of each face, ascending.
std::vector<std::pair<double, double>> shapes(const Faces& faces) {
    std::vector<std::pair<double, double>> result;
    for (std::size_t i = 0; i < faces.faces.size(); ++i) {
        const auto corners = faces.faces.face(i);
        const auto at = [&](std::size_t k) { return faces.faces.vertices[corners[k]]; };
        Vec3d area = Vec3d::Zero();
        for (std::size_t k = 2; k < corners.size(); ++k)
            area += 0.5 * (at(k - 1) - at(0)).cross(at(k) - at(0));
        result.emplace_back(faces.generator_distance[i], area.norm());
    }
    std::sort(result.begin(), result.end());
    return result;
}

TEST(PaperVoronoi, BothEnginesFindTheSameFaces) {
    for (unsigned seed = 1; seed <= 5; ++seed) {
        SCOPED_TRACE(seed);
        const auto points = random_points(seed);
        const auto qhull = voronoi_by_qhull(points, 2.0 * d0, bounds).value();
        const auto cgal = voronoi_by_cgal(points, 2.0 * d0, bounds, 1e-9).value();
        EXPECT_EQ(qhull.voronoi_vertices, cgal.voronoi_vertices);
        const auto expected = shapes(cgal);
        const auto found = shapes(qhull);
        ASSERT_EQ(found.size(), expected.size());
        for (std::size_t i = 0; i < found.size(); ++i) {
            ASSERT_NEAR(found[i].first, expected[i].first, 1e-9);
            ASSERT_NEAR(found[i].second, expected[i].second, 1e-6 * (1.0 + expected[i].second));
        }
    }
}

TEST(PaperVoronoi, QhullReportsWhatItCannotDo) {
    const std::vector<Vec3d> plane{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 2, 0}, {3, 1, 0}};
    EXPECT_FALSE(voronoi_by_qhull(plane, 0.1, bounds));
}

// The least of the faces at a vertex, and so never nearer than d0 to a sample.
TEST(PaperFreeDistance, IsHalfTheLeastGeneratorDistanceLessD0) {
    const auto points = random_points(7);
    const auto found = voronoi_by_cgal(points, 2.0 * d0, bounds, 1e-9).value();
    bake::Stage stage("test", {}, {});
    const bake::MedialMesh mesh = bake::triangulate(found.faces, stage).value();
    const auto face_of = faces_of(mesh, found.faces);
    const auto distances = constant_distances(mesh, face_of, found.generator_distance, d0);

    std::vector<double> least(mesh.vertices.size(), std::numeric_limits<double>::infinity());
    for (std::size_t face = 0; face < found.faces.size(); ++face)
        for (const std::uint32_t corner : found.faces.face(face))
            least[corner] = std::min(least[corner], found.generator_distance[face]);
    for (std::uint32_t vertex = 0; vertex < mesh.vertices.size(); ++vertex) {
        ASSERT_NEAR(distances[vertex], least[vertex] / 2.0 - d0, 1e-4);
        for (const Vec3d& point : points)
            ASSERT_LE(distances[vertex] + d0, (mesh.position(vertex) - point).norm() + 1e-4);
    }
}

}  // namespace
}  // namespace camdir::paper
