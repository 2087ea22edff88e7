// A standby that goes on from the cameras of the director that leads.
#include <gtest/gtest.h>

#include "camera/camera.hpp"
#include "stage.hpp"

namespace camdir::director {
namespace {

class FollowTest : public testing::Test {
  protected:
    static constexpr std::uint32_t begins = 40;  // the standby, with a cut
    // It knows neither how the player has moved yet, nor on which side the leader plans to pass the others.
    static constexpr float near = 5.0F;

    FollowTest() {
        for (std::uint32_t i = 0; i < begins; ++i)
            play_first(i);
    }
    void begin(Stage& stage, const ObserverRequest& wanted) {
        stage.start();
        stage.ask(wanted);
    }
    void play_first(std::uint32_t number) {
        if (number == 0) begin(leader_, wanted_);
        leader_.send(Stage::poses(number));
    }
    // Leader, standby, and the standby's news of the leader.
    void play(std::uint32_t number) {
        leader_.send(Stage::poses(number));
        standby_.send(Stage::poses(number));
        alone_.send(Stage::poses(number));
        standby_.director.follow("m", leader_.publisher.frames().back());
        standby_.director.flush();
    }
    static float distance(const Stage& a, const Stage& b) {
        return (camera(a).position - camera(b).position).norm();
    }
    // frame_time
    static std::int64_t begun(Stage& stage) {
        return stage.director.view(std::chrono::seconds(30)).matches.at(0).shots.at(0).since;
    }
    static ShotCamera camera(const Stage& stage) { return stage.publisher.frames().back().cameras.at(0); }

    ObserverRequest wanted_ = Stage::request("a", 1);
    Stage leader_;
    Stage standby_;
    Stage alone_;  // a standby that does not follow
};

TEST_F(FollowTest, TheCamerasOfAStandbyThatBeganLaterAreTheLeaders) {
    begin(standby_, wanted_);
    begin(alone_, wanted_);
    play(begins);
    play(begins + 1);
    play(begins + 2);
    EXPECT_GT(distance(leader_, alone_), 5.0F);
    EXPECT_LT(distance(leader_, standby_), near);
    EXPECT_EQ(camera(standby_).flags, camera(leader_).flags);
}

TEST_F(FollowTest, NewsOfAFrameThatIsNotProcessedYetWaits) {
    begin(standby_, wanted_);
    for (const std::uint32_t number : {begins, begins + 1}) {
        leader_.send(Stage::poses(number));
        standby_.director.follow("m", leader_.publisher.frames().back());
        standby_.director.flush();
        standby_.send(Stage::poses(number));
    }
    leader_.send(Stage::poses(begins + 2));
    standby_.send(Stage::poses(begins + 2));
    EXPECT_LT(distance(leader_, standby_), near);
}

// The leader's camera has cut since, too: to where is not known yet.
TEST_F(FollowTest, NewsFromBeforeACutChangesNothing) {
    begin(standby_, wanted_);
    begin(alone_, wanted_);
    play(begins);
    leader_.send(Stage::poses(begins + 1));
    PoseFrame teleported = Stage::poses(begins + 2);
    for (PlayerPose& pose : teleported.poses)
        pose.flags |= pose_discontinuity;
    for (Stage* stage : {&standby_, &alone_}) {
        stage->send(Stage::poses(begins + 1));
        stage->send(teleported);
    }
    ASSERT_NE(camera(standby_).flags & camera::cut, 0U);
    standby_.director.follow("m", leader_.publisher.frames().back());
    standby_.director.flush();
    for (Stage* stage : {&standby_, &alone_})
        stage->send(Stage::poses(begins + 3));
    EXPECT_EQ(distance(standby_, alone_), 0.0F);
}

TEST_F(FollowTest, ForeignNewsChangesNothing) {
    begin(standby_, wanted_);
    begin(alone_, wanted_);
    for (std::uint32_t number = begins; number < begins + 5; ++number) {
        standby_.send(Stage::poses(number));
        alone_.send(Stage::poses(number));
        CameraFrame news = standby_.publisher.frames().back();
        news.cameras.at(0).position += Vec3f(1e6F, 0.0F, 0.0F);  // outside of the map
        standby_.director.follow("m", news);
        news.cameras.at(0).camera_id += 1;
        standby_.director.follow("m", news);
        news.epoch += 1;
        standby_.director.follow("m", news);
        standby_.director.follow("another", news);
        standby_.director.flush();
    }
    EXPECT_EQ(distance(standby_, alone_), 0.0F);
}

class FollowAutomatic : public FollowTest {
  protected:
    static constexpr std::uint32_t joins = begins + 20;

    FollowAutomatic() {
        wanted_ = Stage::request("a", no_player);
        leader_.ask(wanted_);
        for (std::uint32_t number = begins; number < joins; ++number)
            leader_.send(Stage::poses(number, 1, {3}));  // nobody else plays yet
        begin(standby_, wanted_);
        begin(alone_, wanted_);
    }
};

TEST_F(FollowAutomatic, TheTargetIsTheLeaders) {
    ASSERT_EQ(camera(leader_).target, 3U);
    for (std::uint32_t number = joins; number < joins + 4; ++number)
        play(number);
    EXPECT_NE(camera(alone_).target, 3U);
    EXPECT_EQ(camera(standby_).target, 3U);
    EXPECT_LT(distance(leader_, standby_), near);

    // What the leader has shown goes on without it.
    standby_.send(Stage::poses(joins + 4));
    EXPECT_EQ(camera(standby_).target, 3U);
    EXPECT_EQ(camera(standby_).flags & camera::cut, 0U);
}

// A standby that came after the cut hears of it with the leader's next repetition.
TEST_F(FollowAutomatic, TheReasonIsTheLeaders) {
    const auto reason = [](const Stage& stage) {
        Reason last;
        for (const CameraFrame& frame : stage.publisher.frames())
            for (const ShotReason& told : frame.reasons)
                last = told.reason;
        return last;
    };
    for (std::uint32_t number = joins; number < joins + 45; ++number) {
        leader_.send(Stage::poses(number));
        CameraFrame news = leader_.publisher.frames().back();
        if (number < joins + 4) news.reasons.clear();
        standby_.send(Stage::poses(number));
        standby_.director.follow("m", news);
        standby_.director.flush();
    }
    ASSERT_EQ(camera(leader_).target, 3U) << "no cut since";
    ASSERT_EQ(camera(standby_).target, 3U);
    EXPECT_NE(reason(leader_).why, "");
    EXPECT_EQ(reason(standby_).why, reason(leader_).why);
}

TEST_F(FollowAutomatic, NewsThatComesAFrameLateCountsToo) {
    ASSERT_EQ(camera(leader_).target, 3U);
    for (std::uint32_t number = joins; number < joins + 8; ++number) {
        const CameraFrame news = leader_.publisher.frames().back();
        standby_.send(Stage::poses(number));
        alone_.send(Stage::poses(number));
        leader_.send(Stage::poses(number));
        standby_.director.follow("m", news);
        standby_.director.flush();
    }
    EXPECT_NE(camera(alone_).target, 3U);
    EXPECT_EQ(camera(standby_).target, 3U);
    EXPECT_LT(distance(leader_, standby_), 20.0F);
}

// Of a leader with another bake, or where fixed cameras are switched on alone.
TEST_F(FollowAutomatic, AFixedCameraThatIsNotThereChangesNothing) {
    for (std::uint32_t number = joins; number < joins + 40; ++number) {
        standby_.send(Stage::poses(number));
        alone_.send(Stage::poses(number));
        CameraFrame news = standby_.publisher.frames().back();
        news.cameras.at(0).target = no_player;
        news.cameras.at(0).flags = 0;
        news.cameras.at(0).position += Vec3f(10.0F, 0.0F, 0.0F);
        standby_.director.follow("m", news);
        standby_.director.flush();
        EXPECT_EQ(camera(standby_).target, camera(alone_).target);
        EXPECT_EQ(distance(standby_, alone_), 0.0F);
        EXPECT_EQ(begun(standby_), begun(alone_));
    }
}

TEST_F(FollowTest, AFixedCameraIsTheLeaders) {
    wanted_ = Stage::request("a", no_player);
    leader_.ask(wanted_);
    std::uint32_t number = begins;
    do {
        if (number % 9 == 0)
            leader_.director.receive("m", MatchEvent{1, Stage::poses(number).frame_time, 1, 3, 2, 0.0F});
        leader_.send(Stage::poses(number++));
    } while (number < 4000 && camera(leader_).target != no_player);
    ASSERT_EQ(camera(leader_).target, no_player);
    begin(standby_, wanted_);
    begin(alone_, wanted_);
    for (const std::uint32_t end = number + 4; number < end; ++number)
        play(number);
    EXPECT_NE(camera(alone_).target, no_player);
    EXPECT_EQ(camera(standby_).target, no_player);
    EXPECT_EQ(camera(standby_).position, camera(leader_).position);
    EXPECT_EQ(camera(standby_).flags & camera::cut, 0U);
}

}  // namespace
}  // namespace camdir::director
