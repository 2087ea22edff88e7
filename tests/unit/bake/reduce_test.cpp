#include "bake/reduce.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "bake/bake.hpp"
#include "bake/certificate.hpp"
#include "support/solid_scenes.hpp"

namespace camdir::bake {
namespace {

using test::SolidScene;

Baked baked(const SolidScene& scene, double loss, std::uint64_t triangles = 0, unsigned threads = 0) {
    Parameters parameters;
    parameters.loss = loss;
    parameters.triangles = triangles;
    parameters.threads = threads;
    return bake(scene.scene(), parameters, {}, {}).value();
}

Slab slab_of(const freespace::Contents& contents, const freespace::Triangle& t) {
    const auto at = [&](std::uint32_t v) -> Vec3d { return contents.vertices[v].position().cast<double>(); };
    const auto r = [&](std::uint32_t v) -> double { return contents.vertices[v].free_distance; };
    return {{at(t.a), at(t.b), at(t.c)}, {r(t.a), r(t.b), r(t.c)}};
}

double distance(const std::vector<Slab>& slabs, const Vec3d& point) {
    double best = -std::numeric_limits<double>::infinity();
    for (const Slab& slab : slabs)
        best = std::max(best, slab.distance(point));
    return best;
}

class Reduce : public testing::TestWithParam<double> {};

// Every centre of the whole mesh keeps its free distance less the loss, and every slab is free.
TEST_P(Reduce, LosesNoMoreThanAllowed) {
    const double loss = GetParam() / 100.0;
    const SolidScene rooms = test::two_rooms();
    const freespace::Contents whole = baked(rooms, 0.0).contents;
    const freespace::Contents reduced = baked(rooms, GetParam()).contents;
    EXPECT_LT(reduced.triangles.size(), whole.triangles.size() / 2);

    const Obstacles obstacles(rooms.scene());
    std::vector<Slab> slabs;
    for (const freespace::Triangle& t : reduced.triangles) {
        slabs.push_back(slab_of(reduced, t));
        ASSERT_TRUE(is_certified(slabs.back(), obstacles));
    }
    for (const freespace::Vertex& v : whole.vertices) {
        if (v.free_distance <= 0.0F) continue;
        const double kept = static_cast<double>(v.free_distance) * (1.0 - loss) - loss * 6.0 * 16.0;
        ASSERT_GE(distance(slabs, v.position().cast<double>()), kept - 1e-6);
    }
}

INSTANTIATE_TEST_SUITE_P(Losses, Reduce, testing::Values(0.5, 3.0, 20.0));

TEST(Reduce, MoreLossLeavesFewerTriangles) {
    const SolidScene room = test::pillar_room();
    std::size_t before = baked(room, 0.0).contents.triangles.size();
    for (const double loss : {1.0, 5.0, 25.0}) {
        const std::size_t left = baked(room, loss).contents.triangles.size();
        EXPECT_LT(left, before);
        before = left;
    }
}

TEST(Reduce, EndsAtTheWantedNumberOfTriangles) {
    const SolidScene room = test::pillar_room();
    const std::size_t whole = baked(room, 0.0).contents.triangles.size();
    const std::size_t least = baked(room, 25.0).contents.triangles.size();
    const std::size_t wanted = (whole + least) / 2;
    const std::size_t left = baked(room, 25.0, wanted).contents.triangles.size();
    EXPECT_LE(left, wanted);
    EXPECT_GT(left, least);
}

TEST(Reduce, IsTheSameForAnyNumberOfThreads) {
    const SolidScene rooms = test::two_rooms();
    EXPECT_EQ(freespace::encode(baked(rooms, 3.0, 0, 1).contents),
              freespace::encode(baked(rooms, 3.0, 0, 2).contents));
}

}  // namespace
}  // namespace camdir::bake
