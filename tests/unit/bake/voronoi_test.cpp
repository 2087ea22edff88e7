#include "bake/voronoi.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <random>

#include "bake/clearance.hpp"
#include "bake/crossing.hpp"
#include "bake/medial_axis.hpp"
#include "bake/sample.hpp"
#include "bake/thin.hpp"
#include "bake/triangulate.hpp"
#include "scene/load.hpp"
#include "support/openarena.hpp"

namespace camdir::bake {
namespace {

std::map<Generators, std::vector<Vec3d>> corners_by_edge(const VoronoiFaces& faces) {
    std::map<Generators, std::vector<Vec3d>> corners;
    for (std::size_t i = 0; i < faces.size(); ++i)
        for (const std::uint32_t corner : faces.face(i))
            corners[faces.generators[i]].push_back(faces.vertices[corner]);
    return corners;
}

double distance_to(const std::vector<Vec3d>& points, const Vec3d& p) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Vec3d& point : points)
        nearest = std::min(nearest, (point - p).norm());
    return nearest;
}

class VoronoiOfRandomSamples : public testing::Test {
  protected:
    [[nodiscard]] VoronoiFaces faces(double weld_distance) {
        return voronoi_faces(samples, diagram, Box3d(Vec3d::Constant(-100), Vec3d::Constant(100)),
                             weld_distance, stage)
            .value();
    }

    static std::vector<Vec3d> random_samples() {
        std::mt19937 random(31);
        std::uniform_real_distribution<double> coordinate(-50.0, 50.0);
        std::vector<Vec3d> points;
        for (int i = 0; i < 500; ++i)
            points.emplace_back(coordinate(random), coordinate(random), coordinate(random));
        return points;
    }

    Stage stage{"voronoi", {}, {}};
    std::vector<Vec3d> samples = random_samples();
    Delaunay diagram = delaunay(samples, std::vector<double>(samples.size(), 0.0), stage).value();
};

TEST_F(VoronoiOfRandomSamples, FacesLieHalfwayBetweenTheirSamples) {
    for (const auto& [edge, corners] : corners_by_edge(faces(0.0))) {
        for (const Vec3d& corner : corners)
            ASSERT_NEAR((corner - samples[edge[0]]).norm(), (corner - samples[edge[1]]).norm(), 1e-6);
    }
}

TEST_F(VoronoiOfRandomSamples, NoVertexIsWeldedToOneFurtherAway) {
    constexpr double weld_distance = 4.0;
    const VoronoiFaces all = faces(0.0);
    const VoronoiFaces welded = faces(weld_distance);
    EXPECT_LT(welded.vertices.size(), 3 * all.vertices.size() / 4);
    const auto before = corners_by_edge(all);
    for (const auto& [edge, corners] : corners_by_edge(welded)) {
        for (const Vec3d& corner : corners)
            ASSERT_EQ(distance_to(all.vertices, corner), 0.0);
        for (const Vec3d& corner : before.at(edge))
            ASSERT_LT(distance_to(corners, corner), weld_distance);
    }
}

// What sampling_distance.hpp promises, for adaptive samples of the surfaces of a real map.
TEST(Voronoi, NoFaceOfSamplesTwiceTheirDistanceApartTouchesAnObstacle) {
    const auto map = test::openarena_map("oa_dm1");
    if (!map) GTEST_SKIP() << test::needs_openarena_map("oa_dm1");
    scene::Scene scene = scene::load(*map).value();
    scene.brushes.clear();  // what they bury has no samples, and is touched
    constexpr double d0 = 32.0;
    constexpr double slack = 0.5;
    Stage stage("voronoi", {}, {});
    const Obstacles obstacles(scene);
    const Solids solids(scene);
    const Probing probing{2.0 * d0, SamplingDistance::reach(8.0 * d0)};
    const SamplingDistance distance(d0, 8.0 * d0, medial_axis(obstacles, solids, probing, stage).value());
    const std::vector<Vec3d> samples =
        thin(sample(scene, solids, distance, slack, stage).value(), slack, stage).value();
    std::vector<double> twice = distances_at(samples, distance, stage).value();
    for (double& length : twice)
        length *= 2.0;
    const Delaunay diagram = delaunay(samples, twice, stage).value();
    const VoronoiFaces faces = voronoi_faces(samples, diagram, scene.bounds, 0.01, stage).value();

    MedialMesh mesh = triangulate(faces, stage).value();
    const std::size_t before = mesh.triangles.size();
    EXPECT_GT(before, 10'000U);
    ASSERT_TRUE(remove_crossing(mesh, clearances(mesh, obstacles, stage).value(), obstacles, stage));
    EXPECT_EQ(mesh.triangles.size(), before);
}

}  // namespace
}  // namespace camdir::bake
