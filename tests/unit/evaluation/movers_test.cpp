#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "box_scene.hpp"
#include "evaluation/figures.hpp"
#include "evaluation/mover_figures.hpp"
#include "evaluation/mover_tracks.hpp"
#include "evaluation/recording.hpp"
#include "evaluation/replay.hpp"
#include "tiny_trace.hpp"

namespace camdir::evaluation {
namespace {

using testing::HasSubstr;

// A wall across the middle of the room, in its own frame at y = 0, with the number 4.
scene::Mover moving_wall() {
    return moving_box("*4", Vec3d(-8.0, -50.0, 0.0), Vec3d(8.0, 50.0, 200.0));
}

// A frame every 100 ms, 0 .. 1200; the player stands at (100, 0, 100) and looks along x.
Trace trace_beside_wall() {
    Trace trace;
    trace.players = {0};
    for (std::int64_t t = 0; t <= 1'200; t += 100)
        add_frame(trace, t, {standing(0, Vec3d(100.0, 0.0, 100.0))});
    return trace;
}

std::vector<MoverRow> mover_rows_of(std::string_view text) {
    return parse_movers(std::as_bytes(std::span(text)), "movers.csv").value();
}

std::string mover_error_of(std::string_view text) {
    const auto rows = parse_movers(std::as_bytes(std::span(text)), "movers.csv");
    return rows ? "" : rows.error().message;
}

constexpr std::string_view mover_header = "t_ms,mover,x,y,z,pitch,yaw,roll\n";

TEST(MoverRows, AreReadInQuakesAxes) {
    const auto rows =
        mover_rows_of("mover,t_ms,z,y,x,roll,yaw,pitch,more\n4,12.5,3,2,1,0,90,0,x\n7,12.5,0,0,0,0,0,90,x\n");
    ASSERT_EQ(rows.size(), 2U);
    EXPECT_EQ(rows[0].time, 12'500'000);
    EXPECT_EQ(rows[0].model, 4U);
    EXPECT_EQ(rows[0].placement.position, Vec3d(1.0, 2.0, 3.0));
    EXPECT_TRUE((rows[0].placement.orientation * Vec3d::UnitX()).isApprox(Vec3d::UnitY(), 1e-9));
    EXPECT_TRUE((rows[1].placement.orientation * Vec3d::UnitX()).isApprox(-Vec3d::UnitZ(), 1e-9));
}

TEST(MoverRows, ErrorsSayWhatIsWrong) {
    const std::string rows(mover_header);
    EXPECT_THAT(mover_error_of("t_ms,mover,x,y,z\n"),
                HasSubstr("movers.csv:1: the header lacks the column \"pitch\""));
    EXPECT_THAT(mover_error_of(rows + "5,1,0,0,0,0,0,0\n4,1,0,0,0,0,0,0\n"),
                HasSubstr("movers.csv:3: column \"t_ms\" goes back"));
    EXPECT_THAT(mover_error_of(rows + "5,-1,0,0,0,0,0,0\n"), HasSubstr("column \"mover\" is \"-1\""));
    EXPECT_THAT(mover_error_of(rows + "5,1,nan,0,0,0,0,0\n"), HasSubstr("column \"x\" is \"nan\""));
    EXPECT_EQ(mover_error_of(rows), "") << "a map may have no movers";
}

TEST(MoverTracks, StandStillWhereTheyHaveNoRowAndMoveBetweenFrames) {
    const Trace trace = trace_beside_wall();
    const std::vector<scene::Mover> movers = {moving_wall()};
    const auto rows =
        mover_rows_of(std::string(mover_header) +
                      "100,4,0,0,0,0,0,0\n100,9,5,0,0,0,0,0\n400,4,0,10,0,0,60,0\n500,4,0,30,0,0,60,0\n");
    const MoverTracks tracks(rows, movers, trace);
    const auto y_at = [&](std::int64_t ms) { return tracks.at(0, ms * 1'000'000)->position.y(); };
    EXPECT_FALSE(tracks.at(0, 99'000'000)) << "not seen yet";
    EXPECT_EQ(y_at(100), 0.0);
    EXPECT_EQ(y_at(300), 0.0);
    EXPECT_NEAR(y_at(350), 5.0, 1e-9);
    EXPECT_NEAR(y_at(400), 10.0, 1e-9);
    EXPECT_NEAR(y_at(450), 20.0, 1e-9);
    EXPECT_EQ(y_at(500), 30.0);
    EXPECT_EQ(y_at(99'000), 30.0);
    const Vec3d forward = tracks.at(0, 350'000'000)->orientation * Vec3d::UnitX();
    EXPECT_TRUE(forward.isApprox(Vec3d(std::cos(30.0 * radians_of_a_degree<double>), 0.5, 0.0), 1e-6));
}

// The figures of cameras that stand at `positions` from 600 ms on, one a frame.
MoverFigures mover_figures_of(const std::vector<Vec3d>& positions, std::string_view movers,
                              bool claims_sight = true, bool cut = false) {
    const Trace trace = trace_beside_wall();
    CameraPath cameras(trace.poses.size());
    for (std::size_t i = 0; i < cameras.size(); ++i) {
        const std::size_t place = i < 6 ? 0 : i - 6;
        cameras[i].position = positions[std::min(place, positions.size() - 1)];
        cameras[i].cut = cut;
        cameras[i].claims_sight = claims_sight;
    }
    const scene::Scene scene = room();
    const oracle::Oracle oracle(scene);
    const auto reachability = oracle::Reachability::explore(oracle, scene, {}, {}).value();
    const auto judgements =
        judge(oracle, reachability, Thresholds(scene.metres_per_unit), trace, cameras, {}).value();
    const std::vector<scene::Mover> all = {moving_wall()};
    const MoverTracks tracks(mover_rows_of(std::string(mover_header) + std::string(movers)), all, trace);
    return judge_movers(all, tracks, trace, cameras, judgements, {}).value();
}

const Vec3d before_it(-60.0, 0.0, 100.0), in_it(0.0, 0.0, 100.0), beyond_it(60.0, 0.0, 100.0),
    beside_it(0.0, 60.0, 100.0);

TEST(MoverFigures, CountWhatMoversHide) {
    EXPECT_EQ(mover_figures_of({before_it}, "0,4,0,0,0,0,0,0\n").seen_through, 7U) << "of 600 .. 1200 ms";
    EXPECT_EQ(mover_figures_of({before_it}, "0,4,0,0,0,0,0,0\n", false).seen_through, 0U);
    EXPECT_EQ(mover_figures_of({before_it}, "0,4,0,200,0,0,0,0\n").seen_through, 0U) << "it is beside";
    EXPECT_EQ(mover_figures_of({before_it}, "0,5,0,0,0,0,0,0\n").seen_through, 0U) << "another model";
    EXPECT_EQ(mover_figures_of({before_it}, "0,4,0,55,0,0,0,0\n").seen_through, 0U);
    EXPECT_EQ(mover_figures_of({before_it}, "0,4,0,55,0,0,90,0\n").seen_through, 0U);
    EXPECT_EQ(mover_figures_of({before_it}, "0,4,0,5,0,0,90,0\n").seen_through, 7U)
        << "turned along the view";
    EXPECT_EQ(mover_figures_of({before_it}, "0,4,0,0,0,0,0,0\n900,4,0,100,0,0,0,0\n").seen_through, 3U);
}

TEST(MoverFigures, CountCamerasInMoversAndPassages) {
    const MoverFigures crossing = mover_figures_of({before_it, in_it, beyond_it}, "0,4,0,0,0,0,0,0\n");
    EXPECT_EQ(crossing.frames_inside, 1U);
    EXPECT_EQ(crossing.passages, 2U) << "in and out";
    const MoverFigures leap = mover_figures_of({before_it, beyond_it}, "0,4,0,0,0,0,0,0\n");
    EXPECT_EQ(leap.frames_inside, 0U);
    EXPECT_EQ(leap.passages, 1U);
    EXPECT_EQ(mover_figures_of({before_it, beyond_it}, "0,4,0,0,0,0,0,0\n", true, true).passages, 0U)
        << "declared";
    const MoverFigures run_over =
        mover_figures_of({in_it}, "0,4,0,100,0,0,0,0\n900,4,0,100,0,0,0,0\n1000,4,0,-100,0,0,0,0\n");
    EXPECT_EQ(run_over.frames_inside, 0U);
    EXPECT_EQ(run_over.passages, 1U) << "the mover comes over the camera";
    const MoverFigures carried = mover_figures_of({beside_it, beside_it + Vec3d(0.0, 100.0, 0.0)},
                                                  "0,4,0,0,0,0,0,0\n700,4,0,100,0,0,0,0\n");
    EXPECT_EQ(carried.passages, 0U) << "both move alike";
}

TEST(MoverTracks, AModelIsNamedByItsNumber) {
    EXPECT_EQ(model_of("*3"), 3U);
    EXPECT_EQ(model_of("*4294967295"), 4294967295U);
    for (const char* name : {"", "*", "3", "boulder", "*3a", "*-3", "* 3", "*4294967296"})
        EXPECT_EQ(model_of(name), std::nullopt) << name;
}

freespace::MoverShape shape_of(const scene::Mover& mover) {
    freespace::MoverShape shape{mover.name, mover.kind, {}, {}, mover.rest.cast<float>()};
    for (const auto& part : mover.parts) {
        freespace::ConvexHull hull{{}, part.bounds.cast<float>()};
        for (const auto& plane : part.planes)
            hull.half_spaces.push_back({plane.normal.cast<float>(), static_cast<float>(plane.distance)});
        shape.hulls.push_back(hull);
    }
    return shape;
}

// A part of the room, in which a mover is in the way.
freespace::Freespace baked_room(const scene::Mover& mover) {
    freespace::Contents contents;
    contents.metadata.map_name = "room";
    contents.metadata.metres_per_unit = 0.0254F;
    contents.metadata.d0 = 16.0F;
    contents.vertices = {{-250, -250, 100, 90}, {250, -250, 100, 90}, {0, 250, 100, 90}};
    contents.triangles = {{0, 1, 2}};
    contents.movers = {shape_of(mover)};
    return freespace::Freespace::parse(freespace::encode(contents), "room").value();
}

// A mover, and a player for 4 s beside it.
struct MovingScene {
    scene::Mover mover;
    Trace trace;
    std::vector<MoverRow> rows;
};

constexpr std::int64_t frame_ms = 16, frames_of_scene = 250;

// The mover's height by time, a row in every frame.
template <class Height, class X>
MovingScene moving_scene(scene::Mover mover, const Height& height_at, const X& x_at) {
    MovingScene made{std::move(mover), {}, {}};
    made.trace.players = {0};
    for (std::int64_t t = 0; t < frame_ms * frames_of_scene; t += frame_ms) {
        const double time = static_cast<double>(t) * 1e-3;
        add_frame(made.trace, t, {standing(0, Vec3d(x_at(time), -100.0, 100.0))});
        made.rows.push_back(
            {t * 1'000'000, 4, {Vec3d(0.0, 0.0, height_at(time)), Eigen::Quaterniond::Identity()}});
    }
    return made;
}

// The player walks through a door that falls shut behind it, before the camera has followed.
MovingScene closing_door() {
    return moving_scene(
        moving_box("*4", {-8.0, -400.0, 0.0}, {8.0, 400.0, 250.0}),
        [](double time) { return 300.0 * std::clamp((1.9 - time) / 0.3, 0.0, 1.0); },
        [](double time) { return std::min(-200.0 + 150.0 * time, 200.0); });
}

// The player stands beside a lift, over which the camera hangs when it comes.
MovingScene rising_lift() {
    return moving_scene(
        moving_box("*4", {-400.0, -400.0, -250.0}, {100.0, 400.0, 0.0}),
        [](double time) { return 250.0 * std::clamp(time - 1.5, 0.0, 1.0); }, [](double) { return 150.0; });
}

// The figures of the tracker that knows the movers by `known`.
MoverFigures tracked_figures(const MovingScene& moving, std::span<const MoverRow> known, double look_ahead) {
    const auto made = record(baked_room(moving.mover), {}, moving.trace, known, moving.trace, look_ahead,
                             [](std::uint64_t, std::uint64_t) {}, {})
                          .value();
    const scene::Scene scene = room();
    const oracle::Oracle oracle(scene);
    const auto reachability = oracle::Reachability::explore(oracle, scene, {}, {}).value();
    const auto judgements =
        judge(oracle, reachability, Thresholds(scene.metres_per_unit), moving.trace, made.cameras, {})
            .value();
    const std::vector<scene::Mover> all = {moving.mover};
    const MoverTracks tracks(moving.rows, all, moving.trace);
    return judge_movers(all, tracks, moving.trace, made.cameras, judgements, {}).value();
}

TEST(KnownMovers, AreWhereTheyAreAlsoForWhoAsksLate) {
    MovingScene moving = rising_lift();
    const freespace::Freespace freespace = baked_room(moving.mover);
    for (const double look_ahead : {0.0, 1.0}) {
        KnownMovers always(freespace, moving.rows, moving.trace, 0, look_ahead);
        KnownMovers late(freespace, moving.rows, moving.trace, 0, look_ahead);
        for (int i = 0; i < 200; ++i)
            static_cast<void>(always.at(0.01 * i));
        const freespace::Movers& expected = always.at(2.0);
        const freespace::Movers& found = late.at(2.0);
        for (double time = 1.6; time < 2.2 + look_ahead; time += 0.05)
            EXPECT_EQ(found.pose_at(0, time)->position, expected.pose_at(0, time)->position) << time;
    }
    moving.rows.resize(1);
    KnownMovers standing(freespace, moving.rows, moving.trace, 0, 0.0);
    EXPECT_EQ(standing.at(3.0).pose_at(0, 3.0)->position, Vec3f::Zero());
}

void expect_none(const MoverFigures& figures) {
    EXPECT_EQ(figures.frames_inside, 0U);
    EXPECT_EQ(figures.passages, 0U);
    EXPECT_EQ(figures.seen_through, 0U);
}

TEST(Recording, KnowsDoors) {
    const MovingScene door = closing_door();
    const MoverFigures ignorant = tracked_figures(door, {}, 0.0);
    EXPECT_GT(ignorant.passages, 0U);
    EXPECT_GT(ignorant.seen_through, 0U);
    expect_none(tracked_figures(door, door.rows, 0.0));
    expect_none(tracked_figures(door, door.rows, 1.0));
}

TEST(Recording, KnowsLifts) {
    const MovingScene lift = rising_lift();
    EXPECT_GT(tracked_figures(lift, {}, 0.0).frames_inside, 0U);
    expect_none(tracked_figures(lift, lift.rows, 0.0));
    expect_none(tracked_figures(lift, lift.rows, 1.0));
}

// What comes later than the look-ahead changes nothing until then.
TEST(Recording, KnowsMoversNoSoonerThanTheirTime) {
    const MovingScene lift = rising_lift();
    constexpr std::size_t until = 100;  // frames: the lift rises
    const auto cameras_of = [&](std::size_t rows) {
        return record(baked_room(lift.mover), {}, lift.trace, std::span(lift.rows).first(rows), lift.trace,
                      0.0, [](std::uint64_t, std::uint64_t) {}, {})
            .value()
            .cameras;
    };
    const CameraPath all = cameras_of(lift.rows.size());
    const CameraPath some = cameras_of(until);
    for (std::size_t i = 0; i < until; ++i)
        EXPECT_EQ(all[i].position, some[i].position) << i;
    EXPECT_NE(all.back().position, some.back().position);
}

TEST(MoverFigures, AreNamedInTableAndJson) {
    Metrics metrics;
    EXPECT_THAT(to_json(metrics), testing::Not(HasSubstr("mover")));
    metrics.movers = MoverFigures{1, 2, 3};
    EXPECT_THAT(to_json(metrics),
                testing::AllOf(HasSubstr("\"mover_frames_inside\": 1"), HasSubstr("\"mover_passages\": 2"),
                               HasSubstr("\"mover_seen_through\": 3")));
    EXPECT_THAT(to_table(metrics), HasSubstr("mover_seen_through 3 frames"));
}

}  // namespace
}  // namespace camdir::evaluation
