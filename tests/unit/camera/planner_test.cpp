// The planner over windows of poses: with and without a recorded future, and at any output rate.
#include "camera/planner.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include "walk.hpp"

namespace camdir::camera {
namespace {

std::vector<TimedPose> run(const test::Plan& plan, std::uint32_t seed, double rate, int poses) {
    Runner runner(plan, plan.eye('s'), seed);
    std::vector<TimedPose> list;
    for (int i = 0; i < poses; ++i)
        list.push_back({static_cast<double>(i) / rate, runner.next(static_cast<float>(1.0 / rate)), true});
    return list;
}

test::Plan long_hall() {
    return test::Plan({"###############",  //
                       "#.............#",  //
                       "#.............#",  //
                       "#.............#",  //
                       "#......s......#",  //
                       "#.............#",  //
                       "#.............#",  //
                       "#.............#",  //
                       "###############"});
}

struct Take {
    std::vector<Camera> cameras;
    std::vector<double> accelerations;  // largest last
};

// Cameras at `output_hz` from poses known up to `look_ahead` seconds ahead; checks each against the plan.
Take take(const test::Plan& plan, const std::vector<TimedPose>& poses, double output_hz, double look_ahead,
          std::size_t history = 60) {
    const freespace::Freespace freespace = plan.freespace();
    const Profile profile = solved_by(Solver::planner);
    Scratch scratch(freespace);
    ShotState state;
    Take take;
    const int frames = static_cast<int>(poses.back().time * output_hz);
    for (int i = 0; i < frames; ++i) {
        const double time = static_cast<double>(i) / output_hz;
        const auto end = static_cast<std::size_t>(index_at(poses, time + look_ahead + 1e-9) + 1);
        const auto now = static_cast<std::size_t>(index_at(poses, time) + 1);
        const std::size_t first = now > history ? now - history : 0;
        const Camera camera =
            step(freespace, profile, Window(poses).subspan(first, end - first), time, state, scratch);
        EXPECT_GE(plan.clearance(camera.position), 4.0F);
        if (i > 0 && (camera.flags & cut) == 0) {
            const Vec3f before = take.cameras.back().position;
            EXPECT_TRUE(plan.segment_clear(before, camera.position));
            EXPECT_LE((camera.position - before).norm(), profile.step_limit);
        }
        take.cameras.push_back(camera);
        if (i >= 2) {
            const Vec3f bend = take.cameras[static_cast<std::size_t>(i)].position -
                               2.0F * take.cameras[static_cast<std::size_t>(i) - 1].position +
                               take.cameras[static_cast<std::size_t>(i) - 2].position;
            take.accelerations.push_back(bend.norm() * output_hz * output_hz);
        }
    }
    std::sort(take.accelerations.begin(), take.accelerations.end());
    return take;
}

// Also after a frame is missing, when all plan.
TEST(Planner, ShotsThatBeginTogetherPlanInDifferentFrames) {
    const test::Plan plan = test::figure_eight();
    const freespace::Freespace freespace = plan.freespace();
    const auto poses = run(plan, 1, 60.0, 120);
    Scratch scratch(freespace);
    std::array<std::array<int, 6>, 2> plans{};  // before and after, by frame
    for (std::uint32_t phase = 600; phase < 606; ++phase) {
        ShotState state;
        state.plan.phase = phase;
        for (std::size_t i = 0; i < 26; ++i) {
            if (i == 13) continue;
            (void)step(freespace, solved_by(Solver::planner), Window(poses).first(i + 60), poses[i].time,
                       state, scratch);
            if (i >= 6 && i < 12 && state.plan.next == 1) ++plans[0][i % 6];
            if (i >= 20 && state.plan.next == 1) ++plans[1][i % 6];
        }
    }
    EXPECT_THAT(plans, testing::Each(testing::Each(1)));
}

// Of a player who runs through the hall, at `speed` units/s, and whose view turns by `flick` with every frame
// and back.
std::vector<TimedPose> forty_poses(double rate, float speed = 0.0F, float flick = 0.0F) {
    std::vector<TimedPose> poses;
    for (int i = 0; i < 40; ++i) {
        Pose pose = pose_at(long_hall().eye('s'), i % 2 == 0 ? 0.0F : flick);
        pose.velocity = {speed, 0.0F, 0.0F};
        pose.eye += static_cast<float>(i / rate) * pose.velocity;
        poses.push_back({i / rate, pose, true});
    }
    return poses;
}

// Frames 20 to 39 of a causal shot in which it planned.
std::vector<std::size_t> planning_frames(const std::vector<TimedPose>& poses, std::uint32_t phase = 0) {
    const freespace::Freespace freespace = long_hall().freespace();
    Scratch scratch(freespace);
    ShotState state;
    state.plan.phase = phase;
    std::vector<std::size_t> frames;
    for (std::size_t i = 0; i < poses.size(); ++i) {
        (void)step(freespace, solved_by(Solver::planner), Window(poses).first(i + 1), poses[i].time, state,
                   scratch);
        if (i >= 20 && state.plan.next == 1) frames.push_back(i);
    }
    return frames;
}

TEST(Planner, FollowsAPlanForAThirtiethOfASecondWhileThePlayerDoesWhatItForesaw) {
    EXPECT_EQ(planning_frames(forty_poses(20.0)).size(), 20);
    EXPECT_EQ(planning_frames(forty_poses(30.0)).size(), 20);
    for (const float speed : {0.0F, 200.0F}) {
        EXPECT_EQ(planning_frames(forty_poses(60.0, speed)).size(), 10);
        EXPECT_EQ(planning_frames(forty_poses(120.0, speed)).size(), 5);
        for (const double rate : {240.0, 500.0})  // no more than eight frames
            EXPECT_THAT(planning_frames(forty_poses(rate, speed)).size(), testing::AnyOf(2, 3)) << rate;
    }
    const auto of_one = planning_frames(forty_poses(60.0), 0);
    const auto of_another = planning_frames(forty_poses(60.0), 1);
    for (const std::size_t frame : of_one)
        EXPECT_THAT(of_another, testing::Not(testing::Contains(frame))) << "both plan in one frame";
}

TEST(Planner, FollowsAPlanWhereTimesAreRoundedToMilliseconds) {
    for (const double rate : {60.0, 72.0, 120.0, 144.0, 240.0}) {
        auto poses = forty_poses(rate, 200.0F);
        for (TimedPose& pose : poses)
            pose.time = 1e-3 * std::round(1e3 * pose.time);
        EXPECT_LE(planning_frames(poses).size(), 1 + 20 / std::lround(rate / 30.0)) << rate;
    }
}

TEST(Planner, PlansAnewOnceThePlayerDoesNotWhatItForesaw) {
    constexpr float degree = radians_of_a_degree<float>;
    EXPECT_EQ(planning_frames(forty_poses(60.0, 0.0F, 0.5F * degree)).size(), 10);
    EXPECT_EQ(planning_frames(forty_poses(60.0, 0.0F, 8.0F * degree)).size(), 20);
    const std::size_t planned = planning_frames(forty_poses(240.0)).front();
    for (std::size_t late = 1; late < PlanState::most_on_prediction; ++late) {
        for (const float push : {3.9F, 4.1F}) {
            auto poses = forty_poses(240.0);
            for (std::size_t i = planned + late; i < poses.size(); ++i)
                poses[i].pose.eye.x() += push;
            const auto frames = planning_frames(poses);
            EXPECT_EQ(std::ranges::count(frames, planned + late), push > 4.0F ? 1 : 0)
                << late << ", " << push;
        }
    }
}

TEST(Planner, KnowingTheFutureMovesMoreSmoothly) {
    const test::Plan plan = test::figure_eight();
    for (std::uint32_t seed = 1; seed <= 3; ++seed) {
        const auto poses = run(plan, seed, 60.0, 1200);
        const Take causal = take(plan, poses, 60.0, 0.0);
        const Take ahead = take(plan, poses, 60.0, 1.0);
        const std::size_t p95 = causal.accelerations.size() * 95 / 100;
        EXPECT_LT(ahead.accelerations[p95], 0.8 * causal.accelerations[p95]);
    }
}

TEST(Planner, GivesCamerasFasterAndSlowerThanPoses) {
    const test::Plan plan = test::figure_eight();
    for (const double output_hz : {20.0, 60.0, 240.0}) {
        for (const double look_ahead : {0.0, 2.0}) {
            SCOPED_TRACE(testing::Message() << output_hz << " Hz, " << look_ahead << " s ahead");
            const Take shots = take(plan, run(plan, 4, 20.0, 200), output_hz, look_ahead);
            int cuts = 0;
            for (const Camera& camera : shots.cameras)
                cuts += (camera.flags & cut) != 0 ? 1 : 0;
            EXPECT_EQ(cuts, 1);
        }
    }
}

TEST(Planner, DoesNotDependOnHistoryBeyondWhatItNeeds) {
    const test::Plan plan = test::l_corridor();
    const auto poses = run(plan, 6, 60.0, 400);
    for (const double look_ahead : {0.0, 1.0}) {
        const Take some = take(plan, poses, 60.0, look_ahead, 30);
        const Take more = take(plan, poses, 60.0, look_ahead, 400);
        for (std::size_t i = 0; i < some.cameras.size(); ++i)
            ASSERT_EQ(some.cameras[i].position, more.cameras[i].position) << "frame " << i;
    }
}

// A shot's cameras follow from its own state alone, whatever its profile was before and whoever planned with
// the same memory in between: nothing that was chosen for another plan's knots is read in this one's.
TEST(Planner, PlansOfAnotherShapeKeepNothingOfTheLastOne) {
    const test::Plan plan = test::figure_eight();
    const freespace::Freespace freespace = plan.freespace();
    Profile slow = solved_by(Solver::planner);
    slow.motion_smoothing = 0.6F;
    const Profile quick = solved_by(Solver::planner);
    for (std::uint32_t seed = 1; seed <= 8; ++seed) {
        const auto poses = run(plan, seed, 60.0, 120);
        const auto others = run(plan, seed + 10, 60.0, 120);
        for (const double ahead : {0.0, 0.3}) {
            auto own = std::make_unique<Scratch>(freespace);
            auto shared = std::make_unique<Scratch>(freespace);
            auto alone = std::make_unique<ShotState>();
            auto among = std::make_unique<ShotState>();
            auto other = std::make_unique<ShotState>();
            for (std::size_t i = 0; i < 100; ++i) {
                const Profile& profile = i % 14 < 7 ? slow : quick;
                const auto end = static_cast<std::size_t>(index_at(poses, poses[i].time + ahead) + 1);
                const auto make = [&](const std::vector<TimedPose>& window, const Profile& by,
                                      ShotState& state, Scratch& scratch) {
                    return step(freespace, by, Window(window).first(end), poses[i].time, state, scratch);
                };
                (void)make(others, i % 3 == 0 ? slow : quick, *other, *shared);
                const Camera one = make(poses, profile, *alone, *own);
                const Camera same = make(poses, profile, *among, *shared);
                ASSERT_EQ(one.position, same.position) << "seed " << seed << ", frame " << i;
                ASSERT_EQ(one.orientation.coeffs(), same.orientation.coeffs());
            }
        }
    }
}

// Where the player has less room than the profile wants, the camera makes do with less instead of being
// rescued from place to place.
TEST(Planner, WantsNoMoreClearanceThanThePlaceHas) {
    const test::Plan plan = test::l_corridor();
    Profile profile = solved_by(Solver::planner);
    profile.minimum_clearance = 60.0F;
    CheckedShot shot(plan, profile);
    Runner runner(plan, plan.eye('s'), 5);
    int hidden = 0;
    double distance = 0.0;
    for (int i = 0; i < 600; ++i) {
        const Pose pose = runner.next(1.0F / 60.0F);
        const Camera camera = shot.step(pose);
        hidden += (camera.flags & target_visible) == 0 ? 1 : 0;
        distance += (camera.position - pose.eye).norm() / 600.0;
    }
    EXPECT_EQ(hidden, 0);
    EXPECT_GT(distance, 0.75 * profile.distance);
}

// A player who was lost without a sign: the rotation of the search does not carry the view past them.
TEST(Planner, KeepsThePlayerInThePictureAfterASearch) {
    const test::Plan plan = test::figure_eight();
    int found = 0;
    for (std::uint32_t seed = 1; seed <= 12; ++seed) {
        CheckedShot shot(plan, solved_by(Solver::planner));
        bool searched = false;
        bool approaching = false;
        int frames_in_view = 0;
        for (const std::uint32_t part : {seed, seed + 100}) {
            Runner runner(plan, plan.eye(part == seed ? 's' : 't'), part);
            for (int i = 0; i < 240; ++i) {
                const Pose pose = runner.next(1.0F / 60.0F);
                const Camera camera = shot.step(pose);
                const bool searches = (camera.flags & searching) != 0;
                if (searched && !searches && (camera.flags & cut) == 0) approaching = true;
                searched = searches;
                const float off =
                    angle_between(camera.orientation * Vec3f::UnitX(), pose.eye - camera.position);
                if (approaching && off < 0.3F) {
                    approaching = false;
                    frames_in_view = 20;
                    ++found;
                }
                if (searches || frames_in_view-- <= 0) continue;
                EXPECT_LT(off, 0.6F) << "seed " << seed << ", frame " << i;
            }
        }
    }
    EXPECT_GT(found, 3);
}

// By poses one after the other, as live, or with all that is known of the last half second; the times are
// exact.
TEST(Planner, NeedsNoMoreHistoryThanItKeeps) {
    const test::Plan plan = test::figure_eight();
    const freespace::Freespace freespace = plan.freespace();
    for (const double hz : {64.0, 256.0}) {
        auto poses = run(plan, 8, hz, 600);
        for (TimedPose& pose : poses)
            pose.time += 1.0 / hz;
        const Profile profile = solved_by(Solver::planner);
        Scratch scratch(freespace);
        const auto live = std::make_unique<ShotState>();
        const auto window = std::make_unique<ShotState>();
        for (std::size_t i = 0; i < poses.size(); ++i) {
            const Camera one = step(freespace, profile, &poses[i].pose, 1.0 / hz, *live, scratch);
            const Camera other =
                step(freespace, profile, Window(poses).first(i + 1), poses[i].time, *window, scratch);
            ASSERT_EQ(one.position, other.position) << hz << " Hz, frame " << i;
        }
    }
}

// Somebody in a hall who looks to and fro, 115 degrees, twice a second: between the two views there is a
// place that is behind both.
TEST(Planner, StandsBehindBothViewsOfAPlayerWhoLooksToAndFro) {
    const test::Plan plan = long_hall();
    std::vector<TimedPose> poses;
    for (int i = 0; i < 600; ++i)
        poses.push_back({i / 60.0, pose_at(plan.eye('s'), i / 15 % 2 == 0 ? 0.0F : 2.0F), true});
    const std::vector<Camera> cameras = take(plan, poses, 60.0, 1.0).cameras;
    std::size_t from_the_side = 0;
    for (std::size_t i = 0; i < cameras.size(); ++i) {
        const Vec3f way = poses[i].pose.eye - cameras[i].position;
        const float off = angle_between(way, poses[i].pose.orientation * Vec3f::UnitX());
        if (off > 60.0F * radians_of_a_degree<float>) ++from_the_side;
    }
    EXPECT_LT(from_the_side, cameras.size() / 10);
}

TEST(Planner, StandsStraightBehindAPlayerWhoStands) {
    const test::Plan plan = test::figure_eight();
    std::vector<TimedPose> poses;
    for (int i = 0; i < 200; ++i)
        poses.push_back({i / 60.0, pose_at(plan.eye(6, 7), 0.0F), true});
    for (const double look_ahead : {0.0, 1.0}) {
        const Camera last = take(plan, poses, 60.0, look_ahead).cameras.back();
        EXPECT_LT((last.position - (plan.eye(6, 7) - Vec3f(120.0F, 0.0F, 0.0F))).norm(), 2.0F);
        EXPECT_LT(angle_between(last.orientation * Vec3f::UnitX(), Vec3f::UnitX()), 0.02F);
    }
}

}  // namespace
}  // namespace camdir::camera
