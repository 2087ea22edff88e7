#include "evaluation/metrics.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "box_scene.hpp"
#include "evaluation/figures.hpp"
#include "tiny_trace.hpp"

namespace camdir::evaluation {
namespace {

constexpr double metres_per_unit = 0.0254;
const Vec3d eye(0, 0, 100);  // of a player who looks along x

CameraSample looking_at(const Vec3d& position, const Vec3d& target, bool cut = false) {
    return {position, Eigen::Quaterniond::FromTwoVectors(Vec3d::UnitX(), target - position), cut};
}

// One player who stands at `eye`; the first counted frame is at 600 ms, then one every 100 ms. The camera
// comes to the first counted place by a cut that belongs to the spawn.
struct Standing {
    Trace trace;
    CameraPath cameras;

    explicit Standing(const std::vector<CameraSample>& counted) {
        trace.players = {0};
        for (std::int64_t t = 0; t <= 500; t += 100) {
            add_frame(trace, t, {standing(0, eye)});
            cameras.push_back(counted.front());
        }
        trace.poses[0].discontinuity = true;
        cameras[0].cut = true;
        for (const CameraSample& camera : counted) {
            add_frame(trace, trace.frames.back().time / 1'000'000 + 100, {standing(0, eye)});
            cameras.push_back(camera);
        }
    }
};

Metrics judge(const scene::Scene& scene, const Trace& trace, const CameraPath& cameras) {
    return measure(scene, oracle::Oracle(scene), trace, cameras, {}, {}).value();
}

Metrics judge(const scene::Scene& scene, const std::vector<CameraSample>& counted) {
    const Standing scenario(counted);
    return judge(scene, scenario.trace, scenario.cameras);
}

TEST(Metrics, APerfectCamera) {
    const Metrics metrics = judge(room(), std::vector(5, looking_at({-120, 0, 100}, eye)));
    EXPECT_EQ(metrics.good, 100.0);
    EXPECT_EQ(metrics.visible_head, 100.0);
    EXPECT_EQ(metrics.visible_body, 100.0);
    EXPECT_EQ(metrics.clearance_lt4, 0.0);
    EXPECT_EQ(metrics.in_solid, 0.0);
    EXPECT_EQ(metrics.fly_through, 0.0);
    EXPECT_EQ(metrics.dist_err, 0.0);
    EXPECT_EQ(metrics.dist_err_p95, 0.0);
    EXPECT_EQ(metrics.too_close, 0.0);
    EXPECT_EQ(metrics.behind, 0.0);
    EXPECT_EQ(metrics.in_frame, 100.0);
    EXPECT_EQ(metrics.acc.rms, 0.0);
    EXPECT_EQ(metrics.jerk.p99, 0.0);
    EXPECT_EQ(metrics.comfort, 100.0);
    EXPECT_EQ(metrics.max_rotation, 0.0);
    EXPECT_EQ(metrics.pops, 0.0);
    EXPECT_EQ(metrics.max_speed, 0.0);
    EXPECT_EQ(metrics.cuts, 0.0);
    EXPECT_EQ(metrics.cuts_at_events, 1.0 * 60 / 1.0);
}

// Each breaks one thing that `good` asks for, beside a perfect one.
TEST(Metrics, EachFailureIsCountedOnce) {
    const CameraSample perfect = looking_at({-120, 0, 100}, eye);
    const auto with = [&](const CameraSample& camera) {
        CameraSample there = camera, back = perfect;
        there.cut = back.cut = true;
        return judge(room(), {perfect, perfect, there, back});
    };
    const Metrics side = with(looking_at({0, -120, 100}, eye));
    EXPECT_EQ(side.good, 75.0);
    EXPECT_NEAR(side.behind, 90.0 / 4, 1e-9);
    EXPECT_NEAR(side.behind_p95, 90.0, 1e-9);
    EXPECT_EQ(side.dist_err, 0.0);

    const Metrics close = with(looking_at({-39, 0, 100}, eye));
    EXPECT_EQ(close.good, 75.0);
    EXPECT_EQ(close.too_close, 25.0);
    EXPECT_NEAR(close.dist_err, 81.0 / 4, 1e-9);
    EXPECT_NEAR(close.dist_err_p95, 81.0, 1e-9);

    const Metrics far = with(looking_at({-181, 0, 100}, eye));
    EXPECT_EQ(far.good, 75.0);
    EXPECT_EQ(far.too_close, 0.0);
    EXPECT_EQ(with(looking_at({-179, 0, 100}, eye)).good, 100.0);

    const Metrics away = with({perfect.position, quake_orientation(0, 180, 0), false});
    EXPECT_EQ(away.good, 75.0);
    EXPECT_EQ(away.in_frame, 75.0);
    EXPECT_EQ(away.visible_head, 100.0);
    EXPECT_NEAR(away.cuts, 2.0 * 60 / 0.9, 1e-9);
}

// The central 60 %: tangents 0.6 across, 0.6 * 9 / 16 up.
TEST(Metrics, FrameIsMeasuredInTangents) {
    const auto share = [&](double pitch, double yaw) {
        return judge(room(), {{Vec3d(-120, 0, 100), quake_orientation(pitch, yaw, 0), false}}).in_frame;
    };
    constexpr double degrees = 180.0 / 3.14159265358979323846;
    EXPECT_EQ(share(0, std::atan(0.599) * degrees), 100.0);
    EXPECT_EQ(share(0, std::atan(0.601) * degrees), 0.0);
    EXPECT_EQ(share(-std::atan(0.337) * degrees, 0), 100.0);
    EXPECT_EQ(share(std::atan(0.338) * degrees, 0), 0.0);
}

TEST(Metrics, APillarHidesThePlayer) {
    scene::Scene scene = room();
    add_box(scene, {-80, -50, 0}, {-60, 50, 200});
    const Metrics hidden = judge(scene, {looking_at({-120, 0, 100}, eye)});
    EXPECT_EQ(hidden.visible_head, 0.0);
    EXPECT_EQ(hidden.visible_body, 0.0);
    EXPECT_EQ(hidden.good, 0.0);
    EXPECT_EQ(hidden.in_solid, 0.0);
}

// A wall up to z = 85 hides the four lower corners (z = 51) from z = 100, not the upper ones nor the centre.
TEST(Metrics, ALowWallHidesTheLegs) {
    scene::Scene scene = room();
    add_box(scene, {-80, -200, 0}, {-60, 200, 85});
    const Metrics metrics = judge(scene, {looking_at({-120, 0, 100}, eye)});
    EXPECT_EQ(metrics.visible_head, 100.0);
    EXPECT_NEAR(metrics.visible_body, 500.0 / 9, 1e-9);
    EXPECT_EQ(metrics.good, 100.0);
}

TEST(Metrics, ClearanceAndSolid) {
    const CameraSample far = looking_at({-120, 0, 100}, eye);
    const auto with = [&](const Vec3d& position) {
        CameraSample there = looking_at(position, eye, true);
        return judge(room(), {far, there});
    };
    const Metrics near_wall = with({-397, 0, 100});
    EXPECT_EQ(near_wall.clearance_lt4, 50.0);
    EXPECT_EQ(near_wall.in_solid, 0.0);
    EXPECT_EQ(with({-395, 0, 100}).clearance_lt4, 0.0);
    const Metrics in_wall = with({-408, 0, 100});
    EXPECT_EQ(in_wall.clearance_lt4, 50.0);
    EXPECT_EQ(in_wall.in_solid, 50.0);
    const Metrics outside = with({-1000, 0, 100});
    EXPECT_EQ(outside.clearance_lt4, 50.0) << "outside the sealed map";
    EXPECT_EQ(outside.in_solid, 50.0);
}

TEST(Metrics, FlyingThroughAWall) {
    scene::Scene scene = room();
    add_box(scene, {-110, -50, 0}, {-105, 50, 200});
    const CameraSample before = looking_at({-120, 0, 100}, eye);
    const CameraSample behind = looking_at({-100, 0, 100}, eye);
    CameraSample cut = behind;
    cut.cut = true;
    EXPECT_NEAR(judge(scene, {before, before, behind, behind}).fly_through, 100.0 / 3, 1e-9);
    EXPECT_EQ(judge(scene, {before, before, cut, behind}).fly_through, 0.0);
}

// 20 units in 0.1 s and back: v = 200, 0, -200, a = 2000, 2000; 9 s between the first and the last frame.
TEST(Metrics, MotionAndRatesByHand) {
    std::vector<CameraSample> counted(85, looking_at({-120, 0, 100}, eye));
    counted[10].position.x() = counted[11].position.x() = -100;
    counted[40].position.x() = -190;  // a pop there and a pop back
    counted[60].cut = true;
    const Standing scenario(counted);
    ASSERT_EQ(scenario.trace.frames.back().time, 9'000'000'000);
    const Metrics metrics = judge(room(), scenario.trace, scenario.cameras);
    EXPECT_NEAR(metrics.pops, 2 * 60.0 / 9, 1e-9);
    EXPECT_NEAR(metrics.max_speed, 700.0, 1e-6);
    EXPECT_NEAR(metrics.cuts, 60.0 / 9, 1e-9);
    EXPECT_NEAR(metrics.cuts_at_events, 60.0 / 9, 1e-9);
    // a: 4 times 2000, then 7000, 14000, 7000; 58 of the first segment and 23 of the second in all.
    EXPECT_NEAR(metrics.acc.rms, std::sqrt((4 * 4e6 + 2 * 49e6 + 196e6) / 81), 1e-6);
    EXPECT_NEAR(metrics.acc.p99, 14000.0, 1e-6);
}

// 11 frames, of which the first has no speed: 13 degrees in 0.1 s once, which the last second keeps below 57.
TEST(Metrics, ComfortIsOfFramesWithASpeed) {
    std::vector<CameraSample> counted(11, looking_at({-120, 0, 100}, eye));
    for (std::size_t i = 5; i < counted.size(); ++i)
        counted[i].orientation = quake_orientation(0, 13, 0);
    EXPECT_EQ(judge(room(), counted).comfort, 90.0);
}

TEST(Metrics, KillInViewIsReportedWhereItWasAskedFor) {
    Metrics metrics;
    EXPECT_THAT(to_json(metrics) + to_table(metrics), testing::Not(testing::HasSubstr("kill_in_view")));
    metrics.kill_in_view = 62.5;
    EXPECT_THAT(to_json(metrics), testing::HasSubstr("\"kill_in_view\": 62.5"));
    EXPECT_THAT(to_table(metrics), testing::HasSubstr("kill_in_view     62.50 %\n"));
    metrics.kill_in_view = unmeasured;
    EXPECT_THAT(to_json(metrics), testing::HasSubstr("\"kill_in_view\": null"));
}

TEST(Metrics, AStepWithTheEyeIsNoPop) {
    Trace trace;
    trace.players = {0};
    CameraPath cameras;
    for (std::int64_t i = 0; i < 20; ++i) {
        const Vec3d at = eye + Vec3d(30.0 * static_cast<double>(i - 8), 0, 0);
        add_frame(trace, 100 * i, {standing(0, at)});
        cameras.push_back(looking_at(at - Vec3d(120, 0, 0), at));
    }
    EXPECT_EQ(judge(room(), trace, cameras).pops, 0.0);
    cameras[10].position.x() -= 59;  // steps of 29 back, then 89 on, of at most 90
    EXPECT_EQ(judge(room(), trace, cameras).pops, 0.0);
    cameras[10].position.x() -= 2;
    EXPECT_GT(judge(room(), trace, cameras).pops, 0.0);
}

// A terrible camera wherever frames are not counted changes nothing about the others.
TEST(Metrics, CountsOnlySettledFramesOfTheLiving) {
    Trace trace;
    trace.players = {0, 1};
    CameraPath cameras;
    const CameraSample perfect = looking_at({-120, 0, 100}, eye);
    const CameraSample terrible = looking_at({-350, 300, 250}, {0, 0, 1000});
    for (std::int64_t t = 0; t <= 3000; t += 100) {
        TracePose alive = standing(0, eye);
        TracePose mortal = standing(1, eye);
        mortal.alive = t < 1500 || t > 1800;
        alive.discontinuity = t == 0;
        mortal.discontinuity = t == 0 || t == 1900;
        add_frame(trace, t, {alive, mortal});
        cameras.push_back(t <= 500 ? terrible : perfect);
        cameras.push_back(t <= 500 || (t >= 1500 && t <= 2400) ? terrible : perfect);
    }
    const Metrics metrics = judge(room(), trace, cameras);
    EXPECT_EQ(metrics.good, 100.0);
    EXPECT_EQ(metrics.acc.rms, 0.0);
    EXPECT_EQ(metrics.max_rotation, 0.0);
    // Leaving the terrible place is a pop of a living player all the same: at 600 twice, at 2500.
    EXPECT_NEAR(metrics.pops, 3 / ((3.0 + 1.4 + 1.1) / 60), 1e-9);
}

TEST(Metrics, NothingCountedIsNotZero) {
    Trace trace;
    trace.players = {0};
    add_frame(trace, 0, {standing(0, eye)});
    const Metrics metrics = judge(room(), trace, {looking_at({-120, 0, 100}, eye)});
    EXPECT_TRUE(std::isnan(metrics.good));
    EXPECT_TRUE(std::isnan(metrics.pops));
    EXPECT_THAT(to_json(metrics), testing::HasSubstr("\"good\": null"));
    EXPECT_THAT(to_table(metrics), testing::HasSubstr("good             - %"));
}

TEST(Metrics, RefusesASceneThatIsTooLargeToExplore) {
    scene::Scene scene = room();
    scene.source = "plain.obj";
    scene.bounds.extend(Vec3d::Constant(4e4));
    const Standing scenario({looking_at({-120, 0, 100}, eye)});
    const auto metrics = measure(scene, oracle::Oracle(scene), scenario.trace, scenario.cameras, {}, {});
    ASSERT_FALSE(metrics);
    EXPECT_THAT(metrics.error().message, testing::StartsWith("plain.obj: the bounds of"));
}

// One judgement a frame, and the figures are their summary.
TEST(Metrics, SummariseTheJudgements) {
    const CameraSample perfect = looking_at({-120, 0, 100}, eye);
    CameraSample close = looking_at({-30, 0, 100}, eye, true);
    const Standing scenario({perfect, close, perfect, perfect});
    const scene::Scene scene = room();
    const oracle::Oracle oracle(scene);
    const auto reachability = oracle::Reachability::explore(oracle, scene, {}, {}).value();
    const auto judgements = evaluation::judge(oracle, reachability, Thresholds(scene.metres_per_unit),
                                              scenario.trace, scenario.cameras, {})
                                .value();
    ASSERT_EQ(judgements.size(), 10U);
    EXPECT_TRUE(judgements[0].cut_at_event);
    EXPECT_FALSE(judgements[5].counted);
    EXPECT_TRUE(judgements[6].counted);
    EXPECT_EQ(judgements[6].faults, 0);
    EXPECT_EQ(judgements[6].clearance, Thresholds(scene.metres_per_unit).largest_clearance);
    EXPECT_TRUE(judgements[7].cut);
    EXPECT_EQ(judgements[7].faults, wrong_distance);
    EXPECT_NEAR(judgements[7].distance_error, 90.0, 1e-9);
    EXPECT_EQ(judgements[7].body_points, body_point_count);
    EXPECT_TRUE(judgements[8].pop);
    EXPECT_NEAR(judgements[8].speed, 900.0, 1e-6);
    EXPECT_EQ(to_json(summarise(judgements)), to_json(judge(scene, scenario.trace, scenario.cameras)));
    EXPECT_EQ(summarise(std::span(judgements).subspan(7, 1)).good, 0.0);
}

// A page shows what to_json has.
TEST(Figures, AreThoseOfTheJson) {
    const Metrics metrics = judge(room(), std::vector(5, looking_at({-120, 0, 100}, eye)));
    std::string names;
    for (const Figure& figure : figures_of(metrics)) {
        EXPECT_FALSE(figure.meaning.empty()) << figure.name;
        names += figure.name + ' ';
    }
    EXPECT_THAT(names, testing::HasSubstr("good visible_head"));
    EXPECT_THAT(names, testing::HasSubstr("acc.rms acc.p95 acc.p99 jerk.rms"));
    EXPECT_EQ(format_value(1.005, 1), "1.0");
    EXPECT_EQ(format_value(unmeasured, 1), "-");
}

// The same match in metres instead of units of 0.0254 m.
TEST(Metrics, ThresholdsScaleWithTheMap) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> wall(-420, 420), height(-20, 320), angle(-180, 180);
    std::vector<CameraSample> counted;
    for (int i = 0; i < 300; ++i) {
        const Vec3d position(wall(random) / (1 + i % 5), wall(random) / (1 + i % 5), height(random));
        counted.push_back(looking_at(position, eye + Vec3d(angle(random), angle(random), 0) / 3, i % 3 == 0));
    }
    Standing units(counted);
    Standing metres(counted);
    for (TracePose& pose : metres.trace.poses) {
        pose.eye *= metres_per_unit;
        pose.view_height *= static_cast<float>(metres_per_unit);
    }
    for (CameraSample& camera : metres.cameras)
        camera.position *= metres_per_unit;
    const Metrics a = judge(room(), units.trace, units.cameras);
    const Metrics b = judge(room(metres_per_unit), metres.trace, metres.cameras);
    EXPECT_EQ(a.good, b.good);
    EXPECT_EQ(a.visible_body, b.visible_body);
    EXPECT_EQ(a.clearance_lt4, b.clearance_lt4);
    EXPECT_EQ(a.in_solid, b.in_solid);
    EXPECT_EQ(a.too_close, b.too_close);
    EXPECT_EQ(a.pops, b.pops);
    EXPECT_NEAR(a.dist_err * metres_per_unit, b.dist_err, 1e-9);
    EXPECT_GT(a.good, 0.0);
    EXPECT_GT(a.in_solid, 0.0);
}

}  // namespace
}  // namespace camdir::evaluation
