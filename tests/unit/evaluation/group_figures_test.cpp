#include "evaluation/group_figures.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "box_scene.hpp"
#include "tiny_trace.hpp"

namespace camdir::evaluation {
namespace {

// A room with a wall from y = -400 to y = 200 at its middle, across x.
scene::Scene walled_room() {
    scene::Scene scene = room();
    add_box(scene, {-8, -400, 0}, {8, 200, 300});
    return scene;
}

CameraSample camera_at(const Vec3d& position, double yaw_degrees, bool cut = false) {
    return {position, quake_orientation(0.0, yaw_degrees, 0.0), cut};
}

// Two players on this side of the wall, then one behind it, then one dead; 50 ms apart.
Trace parted_players() {
    Trace trace;
    trace.players = {2, 7};
    const TracePose first = standing(2, {-200, 0, 100});
    add_frame(trace, 0, {first, standing(7, {-200, 100, 100})});
    add_frame(trace, 1000, {first, standing(7, {-200, 100, 100})});
    add_frame(trace, 1050, {first, standing(7, {200, 100, 100})});
    add_frame(trace, 1100, {first, standing(7, {200, -300, 100})});
    TracePose dead = standing(7, {200, 100, 100});
    dead.alive = false;
    add_frame(trace, 1150, {first, dead});
    return trace;
}

bool always(const Vec3f& /*from*/, const Vec3f& /*to*/) {
    return true;
}

GroupFigures judged(const Trace& trace, std::span<const CameraSample> cameras, std::span<const Vec3f> places,
                    const MoversAt& movers = {}, const Proves& proves = always) {
    const scene::Scene scene = walled_room();
    const std::uint32_t members[] = {2, 7};
    return judge_group(oracle::Oracle(scene), scene.metres_per_unit, trace, members, cameras, places, proves,
                       movers, {})
        .value();
}

TEST(GroupFigures, SayWhatIsShownAndWhatCouldBe) {
    const Trace trace = parted_players();
    // Faces both in the first frames, turns away in the second, and sees the first player alone in the third.
    const Vec3d stand(-100, 50, 100);
    const CameraSample cameras[] = {camera_at(stand, 180), camera_at(stand, 180), camera_at(stand, 180),
                                    camera_at(stand, 0), camera_at(stand, 180)};
    // From beyond the wall's end the second player is seen in the third frame, but not in the fourth.
    const Vec3f places[] = {{-380, 0, 100}, {-100, 390, 100}};
    const GroupFigures figures = judged(trace, cameras, places);
    EXPECT_EQ(figures.frames, 4U) << "not while one is dead";
    EXPECT_DOUBLE_EQ(figures.together, 50.0);
    EXPECT_DOUBLE_EQ(figures.first, 75.0);
    EXPECT_DOUBLE_EQ(figures.empty, 25.0);
    EXPECT_DOUBLE_EQ(figures.possible, 75.0);
    EXPECT_NEAR(figures.together_of_possible, 100.0 * 2 / 3, 1e-9);
    EXPECT_DOUBLE_EQ(figures.fly_through, 0.0);
    EXPECT_DOUBLE_EQ(figures.cuts, 0.0);
}

TEST(GroupFigures, SayWhatTheFreespaceKnows) {
    const Trace trace = parted_players();
    const CameraSample cameras[] = {camera_at({-100, 50, 100}, 180), camera_at({-100, 50, 100}, 180),
                                    camera_at({-100, 50, 100}, 180), camera_at({-100, 390, 100}, -60),
                                    camera_at({-100, 50, 100}, 180)};
    const Vec3f places[] = {{-380, 0, 100}, {-100, 390, 100}};
    const auto of_the_first_place = [&](const Vec3f& from, const Vec3f&) { return from == places[0]; };
    const GroupFigures figures = judged(trace, cameras, places, {}, of_the_first_place);
    EXPECT_DOUBLE_EQ(figures.possible, 75.0);
    EXPECT_DOUBLE_EQ(figures.provable, 50.0) << "the third frame is shown from the second place alone";
    EXPECT_DOUBLE_EQ(figures.together_of_provable, 100.0);
    const GroupFigures by_all = judged(trace, cameras, places);
    EXPECT_DOUBLE_EQ(by_all.provable, by_all.possible);
    EXPECT_DOUBLE_EQ(by_all.together_of_provable, by_all.together_of_possible);
}

// A door comes between the camera and the second player, and then to the camera.
TEST(GroupFigures, MoversHideAndAreInTheWay) {
    const Trace trace = parted_players();
    const Vec3d stand(-100, 50, 100);
    CameraSample camera = camera_at(stand, 180);
    camera.claims_sight = true;
    const std::vector<CameraSample> cameras(5, camera);
    const Vec3f places[] = {{-380, 0, 100}};
    const std::vector<scene::Mover> doors = {moving_box("*1", {-5, -10, 0}, {5, 10, 300})};
    const MoverRow rows[] = {{0, 1, {Vec3d(300, 300, 0), Eigen::Quaterniond::Identity()}},
                             {1'000'000'000, 1, {Vec3d(-150, 75, 0), Eigen::Quaterniond::Identity()}},
                             {1'150'000'000, 1, {Vec3d(-100, 50, 0), Eigen::Quaterniond::Identity()}}};
    const MoverTracks tracks(rows, doors, trace);
    const GroupFigures figures =
        judged(trace, cameras, places, [&](std::int64_t time) { return PlacedMovers(doors, tracks, time); });
    EXPECT_DOUBLE_EQ(figures.together, 25.0);
    EXPECT_DOUBLE_EQ(figures.possible, 50.0);
    ASSERT_TRUE(figures.movers);
    EXPECT_EQ(figures.movers->seen_through, 1U);
    EXPECT_EQ(figures.movers->frames_inside, 1U);
    EXPECT_EQ(figures.movers->passages, 1U);
    EXPECT_NE(to_json(figures).find("\"mover_passages\": 1"), std::string::npos);
    EXPECT_FALSE(judged(trace, cameras, places).movers);
}

TEST(GroupFigures, NothingIsPossibleWhereThePictureCannotHoldAll) {
    Trace trace;
    trace.players = {2, 7};
    add_frame(trace, 0, {standing(2, {-300, -100, 100}), standing(7, {-300, 100, 100})});
    const CameraSample cameras[] = {camera_at({-300, 0, 100}, 90)};
    const Vec3f between[] = {{-300, 0, 100}};
    const GroupFigures figures = judged(trace, cameras, between);
    EXPECT_DOUBLE_EQ(figures.possible, 0.0);
    EXPECT_DOUBLE_EQ(figures.first, 0.0);
    EXPECT_TRUE(std::isnan(figures.together_of_possible));
}

TEST(GroupFigures, CountCutsAcrossTheLineAndStepsThroughWalls) {
    Trace trace;
    trace.players = {2, 7};
    for (const std::int64_t time : {0, 20'000, 40'000, 60'000})
        add_frame(trace, time, {standing(2, {-200, -100, 100}), standing(7, {-200, 100, 100})});
    const CameraSample cameras[] = {camera_at({-100, 0, 100}, 180), camera_at({-300, 0, 100}, 0, true),
                                    camera_at({-350, 0, 100}, 0, true), camera_at({100, 0, 100}, 180)};
    const GroupFigures figures = judged(trace, cameras, {});
    EXPECT_DOUBLE_EQ(figures.cuts, 2.0);
    EXPECT_DOUBLE_EQ(figures.crossings, 1.0);
    EXPECT_DOUBLE_EQ(figures.fly_through, 100.0) << "the one step without a cut";
    EXPECT_DOUBLE_EQ(figures.pops, 1.0);
}

TEST(GroupFigures, AreWrittenByName) {
    const Trace trace = parted_players();
    const std::vector<CameraSample> cameras(trace.frames.size(), camera_at({-100, 50, 100}, 180));
    const GroupFigures figures = judged(trace, cameras, {});
    EXPECT_NE(to_json(figures).find("\"together_of_possible\": null"), std::string::npos);
    EXPECT_NE(to_table(figures).find("together_of_possible - %"), std::string::npos);
}

}  // namespace
}  // namespace camdir::evaluation
