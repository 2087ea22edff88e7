// Requests for several players together.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>

#include "camera/camera.hpp"
#include "delayed_times.hpp"
#include "stage.hpp"

namespace camdir::director {
namespace {

ObserverRequest group_request(const std::string& observer_id, std::vector<std::uint32_t> group) {
    ObserverRequest request = Stage::request(observer_id, whole_group);
    request.group = std::move(group);
    return request;
}

TEST(GroupShotRequest, HasOneCameraThatShowsAll) {
    Stage stage;
    stage.start();
    stage.ask(group_request("o", {3, 1}));
    EXPECT_EQ(stage.publisher.status("o").state, RequestState::accepted);
    for (std::uint32_t number = 0; number < 20; ++number)
        stage.send(Stage::poses(number));
    const auto frames = stage.publisher.frames();
    ASSERT_EQ(frames.size(), 20U);
    for (const CameraFrame& frame : frames) {
        ASSERT_EQ(frame.cameras.size(), 1U);
        const ShotCamera& camera = frame.cameras[0];
        EXPECT_EQ(camera.target, 3U) << "the first of the group";
        EXPECT_EQ((camera.flags & camera::cut) != 0, &frame == frames.data());
        EXPECT_NE(camera.flags & camera::target_visible, 0U);
        EXPECT_GT(camera.clearance, 0.0F);
    }
    const View view = stage.director.view(std::chrono::seconds(30));
    EXPECT_THAT(view.matches.at(0).shots.at(0).group, testing::ElementsAre(3U, 1U));
}

TEST(GroupShotRequest, OfTheSamePlayersInAnotherOrderIsAnotherShot) {
    Stage stage;
    stage.start();
    stage.ask(group_request("a", {3, 1}));
    stage.ask(group_request("b", {1, 3}));
    stage.ask(group_request("c", {3, 1, 3}));
    const auto camera = [&](const char* observer) { return stage.publisher.status(observer).camera_id; };
    EXPECT_NE(camera("a"), camera("b"));
    EXPECT_EQ(camera("a"), camera("c"));
}

TEST(GroupShotRequest, TakesTwoToFourPlayers) {
    Stage stage;
    stage.start(Stage::info("m", 1, {1, 2, 3, 4, 5}));
    for (const auto& group : std::vector<std::vector<std::uint32_t>>{{}, {1}, {2, 2}, {1, 2, 3, 4, 5}}) {
        stage.ask(group_request("o", group));
        const ObserverStatus status = stage.publisher.status("o");
        EXPECT_EQ(status.state, RequestState::refused);
        EXPECT_THAT(status.reason, testing::HasSubstr("2 to 4 players"));
    }
    stage.ask(group_request("o", {1, 2, 3, 4}));
    EXPECT_EQ(stage.publisher.status("o").state, RequestState::accepted);
}

TEST(GroupShotRequest, NamesNoIdThatIsNoPlayers) {
    Stage stage;
    stage.start();
    for (const std::uint32_t id : {no_player, whole_group}) {
        stage.ask(group_request("o", {id, 3}));
        EXPECT_EQ(stage.publisher.status("o").state, RequestState::refused);
        EXPECT_EQ(stage.publisher.status("o").reason, "no player has the id " + std::to_string(id));
        stage.send(Stage::poses(id == no_player ? 1 : 2));
    }
}

TEST(GroupShotRequest, WaitsUntilOneOfItsPlayersPlays) {
    Stage stage;
    stage.start(Stage::info("m", 1, {1}));
    stage.ask(group_request("o", {2, 3}));
    EXPECT_EQ(stage.publisher.status("o").state, RequestState::waiting_for_player);
    EXPECT_EQ(stage.publisher.status("o").reason, "nobody of the group plays");
    stage.send(Stage::poses(1, 1, {1, 3}));
    EXPECT_EQ(stage.publisher.status("o").state, RequestState::accepted);
}

TEST(GroupShotRequest, IsServedWithADelayTheSameWhenItIsPrepared) {
    const auto cameras = [](bool prepared) {
        DelayedTimes match;
        match.tell(group_request("g", {1, 2}));
        match.put_frames(30);
        for (std::uint32_t number = 0; number < 30; ++number) {
            if (prepared) match.at(due(number) - lead_ns);
            match.at(due(number));
        }
        return match.publisher.frames();
    };
    const auto early = cameras(true);
    const auto late = cameras(false);
    ASSERT_EQ(early.size(), 30U);
    ASSERT_EQ(late.size(), 30U);
    for (std::size_t i = 0; i < early.size(); ++i) {
        ASSERT_EQ(early[i].cameras.size(), late[i].cameras.size());
        for (std::size_t c = 0; c < early[i].cameras.size(); ++c) {
            EXPECT_EQ(early[i].cameras[c].position, late[i].cameras[c].position);
            EXPECT_EQ(early[i].cameras[c].flags, late[i].cameras[c].flags);
        }
    }
}

TEST(GroupShotRequest, OfAStandbyGoesOnFromTheLeadersCamera) {
    Stage leader;
    Stage standby;
    leader.start();
    leader.ask(group_request("o", {1, 2}));
    for (std::uint32_t number = 0; number < 40; ++number)
        leader.send(Stage::poses(number));
    standby.start();
    standby.ask(group_request("o", {1, 2}));
    for (std::uint32_t number = 40; number < 44; ++number) {
        leader.send(Stage::poses(number));
        standby.send(Stage::poses(number));
        standby.director.follow("m", leader.publisher.frames().back());
        standby.director.flush();
    }
    const ShotCamera shown = leader.publisher.frames().back().cameras.at(0);
    const ShotCamera own = standby.publisher.frames().back().cameras.at(0);
    EXPECT_EQ(own.camera_id, shown.camera_id);
    EXPECT_LT((own.position - shown.position).norm(), 2.0F);
}

}  // namespace
}  // namespace camdir::director
