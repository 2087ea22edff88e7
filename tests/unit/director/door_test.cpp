// The cameras of a match among its movers.
#include <gtest/gtest.h>

#include <algorithm>

#include "camera/camera.hpp"
#include "freespace/shape_checks.hpp"
#include "stage.hpp"
#include "support/freespace_meshes.hpp"

namespace camdir::director {
namespace {

constexpr std::uint32_t first_closing = 60;
constexpr std::uint32_t frame_count = 200;

// 60 units behind the player, where a camera would look from; open 600 units higher.
Box3f board_in(std::uint32_t number) {
    const float closing = number < first_closing ? 0.0F : 40.0F * static_cast<float>(number - first_closing);
    const Vec3f up = std::max(0.0F, 600.0F - closing) * Vec3f::UnitZ();
    return {Vec3f(-70.0F, -300.0F, -200.0F) + up, Vec3f(-50.0F, 300.0F, 200.0F) + up};
}

bool crosses_board(const Box3f& board, const Vec3f& from, const Vec3f& to) {
    float enter = 0.0F, leave = 1.0F;
    for (int axis = 0; axis < 3; ++axis) {
        const float way = to[axis] - from[axis];
        const bool is_beside = from[axis] <= board.min()[axis] || from[axis] >= board.max()[axis];
        if (way == 0.0F && is_beside) return false;
        if (way == 0.0F) continue;
        const float a = (board.min()[axis] - from[axis]) / way;
        const float b = (board.max()[axis] - from[axis]) / way;
        enter = std::max(enter, std::min(a, b));
        leave = std::min(leave, std::max(a, b));
    }
    return enter < leave;
}

freespace::Freespace wide_hall() {
    freespace::Contents hall = test::square_contents();
    constexpr float w = 1000.0F, h = 150.0F;
    hall.vertices = {{-w, -w, 0.0F, h}, {w, -w, 0.0F, h}, {w, w, 0.0F, h}, {-w, w, 0.0F, h}};
    hall.triangles = {{0, 1, 2}, {0, 2, 3}};
    hall.spawn_points = {{Vec3f::Zero(), 0.0F}};
    return test::make_freespace(hall);
}

std::shared_ptr<const MoverInfo> door_of(std::uint64_t epoch) {
    auto info = std::make_shared<MoverInfo>();
    info->epoch = epoch;
    Mover& door = info->movers.emplace_back();
    door.id = 5;
    const Box3f board = board_in(frame_count);
    freespace::ConvexHull& hull = door.shape.hulls.emplace_back();
    for (int axis = 0; axis < 3; ++axis) {
        hull.half_spaces.push_back({Vec3f::Unit(axis), board.max()[axis]});
        hull.half_spaces.push_back({-Vec3f::Unit(axis), -board.min()[axis]});
    }
    hull.bounds = *freespace::bounds_of(hull.half_spaces);
    return info;
}

// Two players, who stand and look along x.
PoseFrame standing(std::uint32_t number, std::uint64_t epoch) {
    PoseFrame frame = Stage::poses(number, epoch, {1, 2});
    for (PlayerPose& pose : frame.poses) {
        pose.eye = Vec3f(0.0F, pose.player_id == 1 ? 0.0F : 80.0F, 0.0F);
        pose.orientation = Quatf::Identity();
    }
    return frame;
}

class DoorTest : public testing::Test {
  protected:
    DoorTest() {
        stage_.maps.add("hall", false);
        stage_.maps.set_ready("hall", wide_hall());
        begin(1);
    }
    void begin(std::uint64_t epoch) {
        MatchInfo info = Stage::info("m", epoch, {1, 2});
        info.map_name = "hall";
        stage_.start(info);
    }
    // All frames, while the door closes.
    void play_door() {
        const auto info = door_of(1);
        for (std::uint32_t number = 0; number < frame_count; ++number) {
            auto frame = std::make_shared<MoverFrame>();
            frame->epoch = 1;
            const Vec3f place = board_in(number).min() - board_in(frame_count).min();
            frame->poses.push_back({5, place, Quatf::Identity()});
            PoseFrame poses = standing(number, 1);
            poses.movers = std::make_shared<const MatchMovers>(MatchMovers{info, frame});
            stage_.send(poses);
        }
    }
    // Frames from `first` on whose camera shows the players. None may look through the board, or be in it.
    std::size_t shown_from(std::uint32_t first, const std::vector<Vec3f>& eyes) {
        std::size_t shown = 0;
        for (const CameraFrame& frame : stage_.publisher.frames()) {
            const ShotCamera& camera = frame.cameras.at(0);
            const Box3f board = board_in(frame.pose_number);
            EXPECT_FALSE(board.contains(camera.position)) << frame.pose_number;
            if ((camera.flags & camera::target_visible) == 0) continue;
            for (const Vec3f& eye : eyes)
                EXPECT_FALSE(crosses_board(board, camera.position, eye)) << frame.pose_number;
            shown += frame.pose_number >= first ? 1 : 0;
        }
        return shown;
    }
    [[nodiscard]] MatchView view() const {
        return stage_.director.view(std::chrono::seconds(60)).matches.at(0);
    }
    [[nodiscard]] Vec3f last_place() const { return stage_.publisher.frames().back().cameras.at(0).position; }

    Stage stage_;
};

TEST_F(DoorTest, NoCameraLooksThroughIt) {
    stage_.ask(Stage::request("a", 1));
    play_door();
    EXPECT_LT(stage_.publisher.frames().at(first_closing).cameras.at(0).position.x(), -70.0F);
    EXPECT_GT(shown_from(first_closing + 15, {Vec3f::Zero()}), 60U) << "from elsewhere";
    EXPECT_EQ(view().movers, 1U);
    EXPECT_TRUE(view().unknown_movers.empty());
    EXPECT_EQ(stage_.director.statistics()[Counter::mover_frames], frame_count);
}

TEST_F(DoorTest, NoGroupShotLooksThroughIt) {
    ObserverRequest request = Stage::request("a", whole_group);
    request.group = {1, 2};
    stage_.ask(request);
    play_door();
    EXPECT_GT(shown_from(0, {Vec3f::Zero(), Vec3f(0.0F, 80.0F, 0.0F)}), first_closing);
}

TEST_F(DoorTest, ANewEpochForgetsIt) {
    stage_.ask(Stage::request("a", 1));
    play_door();
    begin(2);
    for (std::uint32_t number = 0; number < 100; ++number)
        stage_.send(standing(number, 2));
    EXPECT_LT(last_place().x(), -70.0F) << "behind the player again";
    EXPECT_EQ(view().movers, 0U);
}

TEST_F(DoorTest, WhatHasNoShapeIsReported) {
    auto info = std::make_shared<MoverInfo>();
    info->epoch = 1;
    info->movers = {{7, {"*9", "func_door", {}, {}}}};
    PoseFrame poses = standing(0, 1);
    poses.movers =
        std::make_shared<const MatchMovers>(MatchMovers{info, std::make_shared<const MoverFrame>()});
    stage_.send(poses);
    poses.frame_number = 1;
    stage_.send(poses);
    EXPECT_EQ(view().movers, 0U);
    EXPECT_EQ(view().unknown_movers, std::vector<std::string>{"*9"});
    EXPECT_EQ(stage_.director.statistics()[Counter::unknown_movers], 1U) << "once";
    EXPECT_EQ(stage_.director.statistics()[Counter::mover_frames], 1U);
}

}  // namespace
}  // namespace camdir::director
