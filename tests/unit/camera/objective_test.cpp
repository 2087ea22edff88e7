#include "camera/objective.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "camera/moves.hpp"

namespace camdir::camera {
namespace {

constexpr float dt = 1.0F / 60.0F;
const MapProfile profile(Profile{}, 0.0254F);

PlayerTrack player_at_origin() {
    PlayerTrack track;
    track.heading = Vec3f::UnitX();
    return track;
}

// Behind the player at d_opt, where it was before: nothing to complain about.
Candidate ideal() {
    return {Vec3f(-profile.distance, 0.0F, 0.0F), 0, 50.0F, 50.0F};
}
Motion at_rest() {
    return {ideal().position, Vec3f::Zero(), dt};
}

TEST(Objective, IsZeroAtRestInTheIdealSpot) {
    const ObjectiveTerms terms = objective(profile, player_at_origin(), at_rest(), ideal());
    EXPECT_EQ(terms.visibility, 1.0F);
    EXPECT_NEAR(terms.total, 0.0F, 1e-6F);
}

TEST(Objective, EachToleranceCostsItsWeight) {
    Profile weighted;
    weighted.weight_distance = 2.0F;
    weighted.weight_angle = 3.0F;
    const MapProfile scaled(weighted, 0.0254F);
    Candidate far = ideal();
    far.position.x() -= scaled.distance_tolerance;
    EXPECT_NEAR(objective(scaled, player_at_origin(), {far.position, Vec3f::Zero(), dt}, far).distance, 2.0F,
                1e-4F);
    Candidate aside = ideal();
    aside.position = Eigen::AngleAxisf(scaled.angle_tolerance, Vec3f::UnitZ()) * aside.position;
    EXPECT_NEAR(objective(scaled, player_at_origin(), {aside.position, Vec3f::Zero(), dt}, aside).angle, 3.0F,
                1e-4F);
}

TEST(Objective, InertiaAsksForTheMotionBefore) {
    const Vec3f velocity(0.0F, 300.0F, 0.0F);
    Candidate on = ideal();
    on.position += velocity * dt;
    ObjectiveTerms terms = objective(profile, player_at_origin(), {ideal().position, velocity, dt}, on);
    EXPECT_NEAR(terms.inertia_distance, 0.0F, 1e-3F);
    EXPECT_NEAR(terms.inertia_angle, 0.0F, 1e-3F);
    terms = objective(profile, player_at_origin(), {ideal().position, velocity, dt}, ideal());
    EXPECT_NEAR(terms.inertia_distance, 0.5625F, 1e-3F) << "(300 / 400)^2";
    on.position = ideal().position - velocity * dt;
    terms = objective(profile, player_at_origin(), {ideal().position, velocity, dt}, on);
    EXPECT_NEAR(terms.inertia_distance, 0.0F, 1e-3F);
    EXPECT_GT(terms.inertia_angle, 1.0F);
}

TEST(Objective, SafetyGrowsWithSpeedAndNarrowness) {
    Candidate moved = ideal();
    moved.position.y() += profile.safe_speed * dt;
    moved.clearance = profile.minimum_clearance;
    EXPECT_NEAR(objective(profile, player_at_origin(), at_rest(), moved).safety, 1.0F, 1e-3F);
    moved.clearance *= 0.5F;
    EXPECT_NEAR(objective(profile, player_at_origin(), at_rest(), moved).safety, 2.0F, 1e-3F);
}

TEST(Objective, VisibilityMultipliesTheSumAndNotSeeingIsWorst) {
    Candidate candidate = ideal();
    candidate.position.x() -= profile.distance_tolerance;
    const Motion motion{candidate.position, Vec3f::Zero(), dt};
    candidate.sight_clearance = 0.5F * profile.minimum_clearance;
    const ObjectiveTerms narrow = objective(profile, player_at_origin(), motion, candidate);
    EXPECT_NEAR(narrow.visibility, 2.0F, 1e-5F);
    EXPECT_NEAR(narrow.total, 2.0F * narrow.distance, 1e-4F);
    candidate.sight_clearance = 0.0F;
    const ObjectiveTerms unseen = objective(profile, player_at_origin(), motion, candidate);
    EXPECT_GT(unseen.total, 1e5F);
    EXPECT_TRUE(std::isfinite(unseen.total));
}

// A camera that follows `moves` towards a resting spot for 0.2 s in steps of dt.
Vec3f after_fifth_of_a_second(int steps) {
    const float step = 0.2F / static_cast<float>(steps);
    MapProfile calm = profile;
    calm.weight_safety = 0.0F;
    Vec3f position = Vec3f::Zero();
    Vec3f move = Vec3f(300.0F, -100.0F, 0.0F) * step;
    for (int i = 0; i < steps; ++i) {
        Moves moves;
        moves.spot = Vec3f(100.0F, 50.0F, 20.0F) - position;
        moves.inertia = move;
        move = average_when_seen(calm, moves, move.norm() / step, step);
        position += move;
    }
    return position;
}

TEST(Moves, TheAverageBehavesAlikeAtEveryRate) {
    const Vec3f fine = after_fifth_of_a_second(200);
    EXPECT_LT((after_fifth_of_a_second(12) - fine).norm(), 6.0F) << "60 Hz";
    EXPECT_LT((after_fifth_of_a_second(4) - fine).norm(), 16.0F) << "20 Hz";
}

TEST(Moves, TheCameraKeepsUpWithARunningPlayer) {
    const Vec3f run = Vec3f(320.0F, 0.0F, 0.0F) * dt;
    Moves moves;
    moves.spot = run;  // it stood in its spot, which then went with the player
    moves.inertia = run;
    moves.visibility = run;
    MapProfile calm = profile;
    calm.weight_safety = 0.0F;
    EXPECT_TRUE(average_when_seen(calm, moves, 320.0F, dt).isApprox(run, 1e-5F));
}

TEST(Moves, UrgencyForcesTheCameraOntoTheRoadmap) {
    Moves moves;
    moves.spot = Vec3f(-50.0F, 0.0F, 0.0F);
    moves.visibility = Vec3f(50.0F, 0.0F, 0.0F);
    EXPECT_NEAR(average_when_lost(profile, moves, 1.0F, dt).x(), 0.0F, 1e-4F);
    EXPECT_GT(average_when_lost(profile, moves, 1000.0F, dt).x(), 2.0F);
}

}  // namespace
}  // namespace camdir::camera
