#include "bake/voronoi.hpp"

#include <gtest/gtest.h>

#include "bake/clearance.hpp"
#include "bake/crossing.hpp"
#include "bake/medial_axis.hpp"
#include "bake/sample.hpp"
#include "bake/triangulate.hpp"
#include "bake/weld.hpp"
#include "scene/load.hpp"
#include "support/openarena.hpp"

namespace camdir::bake {
namespace {

// What sampling_distance.hpp promises, for adaptive samples of the surfaces of a real map.
TEST(Voronoi, NoFaceOfSamplesTwiceTheirDistanceApartTouchesAnObstacle) {
    const auto map = test::openarena_map("oa_dm1");
    if (!map) GTEST_SKIP() << "oa_dm1 of package openarena-081-maps is missing";
    scene::Scene scene = scene::load(*map).value();
    scene.brushes.clear();  // what they conceal has no samples, and is touched
    constexpr double d0 = 32.0;
    constexpr double slack = 0.5;
    Stage stage("voronoi", {}, {});
    const Obstacles obstacles(scene);
    const Solids solids(scene);
    const Probing probing{2.0 * d0, SamplingDistance::reach(8.0 * d0)};
    const SamplingDistance distance(d0, 8.0 * d0, medial_axis(obstacles, solids, probing, stage).value());
    const std::vector<Vec3d> samples =
        weld(sample(scene, solids, distance, slack, stage).value(), slack, stage).value();
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
