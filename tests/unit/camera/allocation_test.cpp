// step() does not allocate.
#include <gtest/gtest.h>

#include "support/allocations.hpp"
#include "walk.hpp"

namespace camdir::camera {
namespace {

TEST(Allocation, NoStepAllocates) {
    const test::Plan plan = test::l_corridor();
    const freespace::Freespace freespace = plan.freespace();
    std::vector<Pose> poses;
    for (int i = 0; i < 600; ++i) {  // lost every 100 frames: the roadmap is searched
        poses.push_back(pose_at(plan.eye(i / 100 % 2 == 0 ? 's' : 't'), 0.01F * static_cast<float>(i)));
    }
    poses[500].discontinuity = true;

    for (const Solver solver : {Solver::paper, Solver::planner}) {
        Profile profile = solved_by(solver);
        profile.search_time_limit = 3.0F;
        Scratch scratch(freespace);
        ShotState state;
        int searched = 0;
        const long before = test::allocations();
        for (const Pose& pose : poses) {
            searched += (step(freespace, profile, &pose, 1.0 / 60.0, state, scratch).flags & searching) != 0;
        }
        EXPECT_EQ(test::allocations() - before, 0) << name_of(solver);
        EXPECT_GT(searched, 10) << name_of(solver);
    }
}

}  // namespace
}  // namespace camdir::camera
