// What step() promises whatever comes in, over random players and random nonsense.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>

#include "walk.hpp"

namespace camdir::camera {
namespace {

struct World {
    const char* name;
    test::Plan (*plan)();
};

void PrintTo(const World& world, std::ostream* out) {
    *out << world.name;
}

class EveryWorld : public testing::TestWithParam<World> {};

INSTANTIATE_TEST_SUITE_P(Plans, EveryWorld,
                         testing::Values(World{"box", test::box_room}, World{"l", test::l_corridor},
                                         World{"eight", test::figure_eight}, World{"two", test::two_rooms}),
                         [](const auto& each) { return std::string(each.param.name); });

TEST_P(EveryWorld, RunningPlayerIsFollowedThroughFreespaceWithoutCuts) {
    const test::Plan plan = GetParam().plan();
    for (const auto& [solver, rate] :
         {std::pair{Solver::paper, 60.0F}, std::pair{Solver::paper, 20.0F}, std::pair{Solver::planner, 60.0F},
          std::pair{Solver::planner, 20.0F}}) {
        for (std::uint32_t seed = 1; seed <= 3; ++seed) {
            SCOPED_TRACE(testing::Message()
                         << name_of(solver) << ", seed " << seed << " at " << rate << " Hz");
            CheckedShot shot(plan, solved_by(solver));
            Runner runner(plan, plan.eye('s'), seed);
            int seen = 0;
            const int frames = static_cast<int>(20.0F * rate);
            for (int i = 0; i < frames; ++i) {
                const Pose pose = runner.next(1.0F / rate);
                const Camera camera = shot.step(pose, 1.0 / rate);
                seen += plan.segment_clear(camera.position, pose.eye) ? 1 : 0;
                if (HasFatalFailure()) return;
            }
            EXPECT_EQ(shot.cuts(), 1) << "the first frame only";
            EXPECT_GE(seen, frames * 99 / 100);
        }
    }
}

// Poses that no game should send: anywhere, in walls, not finite, missing, at odd times.
TEST_P(EveryWorld, NonsenseNeverBreaksAPromise) {
    const test::Plan plan = GetParam().plan();
    for (std::uint32_t seed = 1; seed <= 16; ++seed) {
        const Solver solver = seed % 2 == 0 ? Solver::paper : Solver::planner;
        SCOPED_TRACE(testing::Message() << name_of(solver) << ", seed " << seed);
        std::mt19937 random(seed);
        const auto between = [&](float low, float high) {
            return std::uniform_real_distribution<float>(low, high)(random);
        };
        const auto odd_number = [&] {
            constexpr float infinity = std::numeric_limits<float>::infinity();
            constexpr float numbers[] = {
                0.0F, -0.0F, infinity, -infinity, 1e38F, 1e-38F, std::numeric_limits<float>::quiet_NaN()};
            return numbers[random() % std::size(numbers)];
        };
        CheckedShot shot(plan, solved_by(solver));
        Runner runner(plan, plan.eye('s'), seed);
        for (int i = 0; i < 400; ++i) {
            Pose pose = runner.next(1.0F / 60.0F);
            const auto what = random() % 40;
            if (what == 0) pose.eye = plan.bounds().sample();
            if (what == 1) pose.eye[static_cast<int>(random() % 3)] = odd_number();
            if (what == 2) pose.orientation.coeffs()[static_cast<int>(random() % 4)] = odd_number();
            if (what == 3) pose.velocity[static_cast<int>(random() % 3)] = odd_number();
            if (what == 4) pose.discontinuity = true;
            pose.alive = what != 5;
            const double dt = what == 7 ? odd_number() : between(-0.01F, 0.05F);
            shot.step(what == 6 ? nullptr : &pose, dt);
            if (HasFatalFailure()) return;
        }
    }
}

}  // namespace
}  // namespace camdir::camera
