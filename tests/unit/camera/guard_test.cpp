// The guard on random steps: never outside, never through.
#include "camera/guard.hpp"

#include <gtest/gtest.h>

#include <random>

#include "freespace/distance.hpp"
#include "walk.hpp"

namespace camdir::camera {
namespace {

TEST(Guard, NeverLeavesTheFreespaceNorGoesThroughAnything) {
    const MapProfile profile(Profile{}, 0.0254F);
    for (const auto& make : {test::box_room, test::l_corridor, test::figure_eight, test::two_rooms}) {
        const test::Plan plan = make();
        const freespace::Freespace freespace = plan.freespace();
        std::mt19937 random(5);
        std::normal_distribution<float> far(0.0F, 80.0F);
        const auto offset = [&] { return Vec3f(far(random), far(random), 0.3F * far(random)); };
        int found = 0;
        for (std::uint32_t seed = 1; seed <= 6; ++seed) {
            Runner runner(plan, plan.eye('s'), seed);
            PlayerTrack track;
            freespace::RecentBalls recent;
            restart(freespace, profile, runner.next(1.0F / 60.0F), track);
            for (int i = 0; i < 300; ++i) {
                follow(freespace, profile, runner.next(1.0F / 60.0F), 1.0F / 60.0F, track);
                const Vec3f from = track.anchor + offset();
                const freespace::Distance place = freespace::distance(freespace, from);
                if (!place.covered()) continue;
                const Motion motion{from, Vec3f::Zero(), 1.0F / 60.0F};
                const auto next = guarded(freespace, profile, track, motion, track.anchor + offset(), recent);
                if (!next) continue;
                ++found;
                EXPECT_GT(plan.clearance(next->position), 0.0F);
                EXPECT_TRUE(plan.segment_clear(from, next->position));
                EXPECT_TRUE(plan.segment_clear(next->position, track.anchor));
                EXPECT_LE((next->position - from).norm(), profile.step_limit * 1.001F);
            }
        }
        EXPECT_GT(found, 200);
    }
}

}  // namespace
}  // namespace camdir::camera
