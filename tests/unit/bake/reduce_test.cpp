#include "bake/reduce.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "bake/bake.hpp"
#include "bake/geometry/certificate.hpp"
#include "base/disjoint_sets.hpp"
#include "support/solid_scenes.hpp"
#include "unit/bake/safety.hpp"

namespace camdir::bake {
namespace {

using test::SolidScene;

Baked reduced_bake(const SolidScene& scene, double loss, std::uint64_t triangles = 0) {
    Parameters parameters;
    parameters.loss = loss;
    parameters.triangles = triangles;
    return bake(scene.scene(), parameters, {}, {}).value();
}

double distance(const std::vector<Slab>& slabs, const Vec3d& point) {
    double best = -std::numeric_limits<double>::infinity();
    for (const Slab& slab : slabs)
        best = std::max(best, slab.distance(point));
    return best;
}

// A room with boxes at random places in it, and a spawn point where none are.
SolidScene random_room(unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    SolidScene room(Box3d(Vec3d(0, 0, 0), Vec3d(256, 192, 128)));
    for (int i = 0; i < 4; ++i) {
        const Vec3d corner(70.0 + 150.0 * unit(random), 160.0 * unit(random), 100.0 * unit(random));
        const Vec3d size(8.0 + 60.0 * unit(random), 8.0 + 60.0 * unit(random), 8.0 + 90.0 * unit(random));
        room.add(Box3d(corner, corner + size));
    }
    return room.spawn({30, 96, 64});
}

// Components of the edges between vertices with a ball.
std::size_t roadmap_components(const freespace::Contents& contents) {
    DisjointSets parts(contents.vertices.size());
    const auto on_roadmap = [&](std::uint32_t v) { return contents.vertices[v].free_distance > 0.0F; };
    for (const freespace::Triangle& t : contents.triangles)
        for (const auto& [a, b] : {std::pair(t.a, t.b), std::pair(t.b, t.c), std::pair(t.c, t.a)})
            if (on_roadmap(a) && on_roadmap(b)) parts.unite(a, b);
    std::set<std::uint32_t> found;
    for (std::uint32_t v = 0; v < contents.vertices.size(); ++v)
        if (on_roadmap(v)) found.insert(parts.find(v));
    return found.size();
}

// In map units: `percent` of what a random point of the mesh has, but at most 3/2 d0.
double allowed_loss(const freespace::Contents& unreduced, double percent) {
    double sum = 0.0;
    double areas = 0.0;
    for (const freespace::Triangle& t : unreduced.triangles) {
        const std::array<freespace::Vertex, 3> v{unreduced.vertices[t.a], unreduced.vertices[t.b],
                                                 unreduced.vertices[t.c]};
        const double of_one = area(
            {v[0].position().cast<double>(), v[1].position().cast<double>(), v[2].position().cast<double>()});
        for (const freespace::Vertex& corner : v)
            sum += of_one * std::max(0.0F, corner.free_distance) / 3.0;
        areas += of_one;
    }
    return std::min(percent / 100.0 * sum / areas, 1.5 * 16.0);
}

// Every centre of the unreduced mesh keeps its free distance less the loss.
void expect_kept(const freespace::Contents& unreduced, const freespace::Contents& reduced, double percent) {
    const std::vector<Slab> slabs = slabs_of(reduced);
    const double loss = allowed_loss(unreduced, percent);
    for (const freespace::Vertex& v : unreduced.vertices) {
        const double kept = v.free_distance - loss;
        if (kept <= 0.0) continue;
        ASSERT_GE(distance(slabs, v.position().cast<double>()), kept - 1e-4);
    }
}

class Reduce : public testing::TestWithParam<double> {};

TEST_P(Reduce, LosesNoMoreThanAllowed) {
    const SolidScene rooms = test::two_rooms();
    const freespace::Contents unreduced = reduced_bake(rooms, 0.0).contents;
    const freespace::Contents reduced = reduced_bake(rooms, GetParam()).contents;
    EXPECT_LT(reduced.triangles.size(), unreduced.triangles.size() / 2);
    expect_kept(unreduced, reduced, GetParam());
    expect_safe(rooms, reduced);
    const Obstacles obstacles(rooms.scene());
    for (const Slab& slab : slabs_of(reduced))
        ASSERT_TRUE(is_certified(slab, obstacles));
}

INSTANTIATE_TEST_SUITE_P(Losses, Reduce, testing::Values(1.0, 5.0, 16.0, 100.0));

TEST(Reduce, IsSafeAndKeepsTheRoadmapWhateverTheRoom) {
    for (unsigned seed = 1; seed <= 20; ++seed) {
        SCOPED_TRACE(seed);
        const double loss = seed % 2 == 0 ? 20.0 : 10.0;
        const SolidScene room = random_room(seed);
        const freespace::Contents unreduced = reduced_bake(room, 0.0).contents;
        const freespace::Contents reduced = reduced_bake(room, loss).contents;
        expect_kept(unreduced, reduced, loss);
        expect_safe(room, reduced);
        EXPECT_EQ(roadmap_components(reduced), roadmap_components(unreduced));
        EXPECT_GT(distance(slabs_of(reduced), room.scene().spawn_points[0].eye), 0.0);
    }
}

TEST(Reduce, SpawnPointsKeepHalfOfTheirDistanceWhateverTheLoss) {
    for (const Vec3d& spawn :
         {Vec3d(12.0, 96.0, 12.0), Vec3d(128.0, 182.0, 64.0), Vec3d(244.0, 12.0, 20.0)}) {
        SolidScene room(Box3d(Vec3d(0, 0, 0), Vec3d(256, 192, 128)));
        room.spawn(spawn);
        const double before = distance(slabs_of(reduced_bake(room, 0.0).contents), spawn);
        ASSERT_GT(before, 0.0);
        ASSERT_LT(before, 16.0) << "or the loss alone keeps it covered";
        EXPECT_GE(distance(slabs_of(reduced_bake(room, 100.0).contents), spawn), 0.5 * before);
    }
}

TEST(Reduce, MoreLossLeavesFewerTriangles) {
    const SolidScene room = test::pillar_room();
    std::size_t before = reduced_bake(room, 0.0).contents.triangles.size();
    for (const double loss : {0.3, 3.0, 20.0}) {
        const std::size_t left = reduced_bake(room, loss).contents.triangles.size();
        EXPECT_LT(left, before);
        before = left;
    }
}

TEST(Reduce, EndsNearTheTargetNumberOfTriangles) {
    const SolidScene room = test::pillar_room();
    const std::size_t unreduced = reduced_bake(room, 0.0).contents.triangles.size();
    const std::size_t least = reduced_bake(room, 20.0).contents.triangles.size();
    for (const std::size_t target : {(unreduced + least) / 2, 2 * least}) {
        const std::size_t left = reduced_bake(room, 20.0, target).contents.triangles.size();
        EXPECT_LE(left, target);
        EXPECT_GT(left, target - target / 10);
    }
}

TEST(Reduce, IsTheSameForAnyNumberOfThreads) {
    const scene::Scene rooms = test::two_rooms().scene();
    Parameters parameters;
    parameters.d0 = 4.0;
    parameters.sampling = Sampling::uniform;
    const auto baked = [&](double loss, unsigned threads) {
        parameters.loss = loss;
        parameters.threads = threads;
        return bake(rooms, parameters, {}, {}).value().contents;
    };
    ASSERT_GT(baked(0.0, 2).vertices.size(), 4 * region_size) << "or there is one region only";
    EXPECT_EQ(freespace::encode(baked(20.0, 1)), freespace::encode(baked(20.0, 2)));
}

}  // namespace
}  // namespace camdir::bake
