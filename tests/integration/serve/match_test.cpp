// A match with a real server over real DDS.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <csignal>
#include <limits>
#include <optional>

#include "hall.hpp"
#include "support/eventually.hpp"
#include "support/raw_peer.hpp"
#include "support/test_domain.hpp"

namespace camdir::test {
namespace {

using camera_director::Context;
using camera_director::Observer;
using testing::HasSubstr;

class MatchTest : public testing::Test {
  protected:
    void SetUp() override { ASSERT_TRUE(server_.ready()) << server_.log(); }

    TestDomain domain_;
    Server server_{domain_.id()};
    Context context_ = Context::open(connection(domain_.id())).value();
};

TEST_F(MatchTest, EveryObserverGetsItsOwnCameraInsideTheFreespace) {
    const Game game(context_, "cup", "hall");
    Observer first = Observer::open(context_, "cup", "first").value();
    Observer second = Observer::open(context_, "cup", "second").value();
    first.request({.target = 1}).value();
    second.request({.target = 2}).value();
    ASSERT_TRUE(comes_to(first, CDIR_SHOT_ACCEPTED)) << server_.log();
    ASSERT_TRUE(comes_to(second, CDIR_SHOT_ACCEPTED));
    ASSERT_NE(first.shot_status().value().camera_id, second.shot_status().value().camera_id);

    int frames = 0;
    std::uint64_t missing = 0;  // 0 unless this machine is busy for longer than 32 frames
    const std::uint64_t missed = first.counters().value().gaps;
    std::optional<camera_director::CameraFrame> before;
    EXPECT_TRUE(sees(first, [&](const auto& frame, auto cameras) {
        if (before) {
            EXPECT_GT(frame.frame_number, before->frame_number);
            EXPECT_GT(frame.frame_time, before->frame_time);
            missing += frame.frame_number - before->frame_number - 1;
        }
        before = frame;
        EXPECT_EQ(frame.director_id, 1U);
        for (const auto& camera : cameras) {
            EXPECT_LE(std::abs(camera.position[2]), hall_half_height);
            EXPECT_LE(std::hypot(camera.position[0], camera.position[1]), hall_half_width);
            const auto own = first.shot_status().value();
            if (camera.camera_id == own.camera_id) {
                EXPECT_EQ(camera.target, 1U);
                ++frames;
            }
        }
        return frames >= 60;
    }));
    EXPECT_GE(first.counters().value().gaps - missed, missing);
}

TEST_F(MatchTest, AnAutomaticShotSaysWhy) {
    const Game game(context_, "cup", "hall");
    Observer observer = Observer::open(context_, "cup", "anna").value();
    observer.request({.target = CDIR_CHOOSE_TARGET}).value();
    ASSERT_TRUE(sees_own_camera(observer)) << server_.log();
    EXPECT_TRUE(eventually([&] {
        observer.poll().value();
        const auto view = observer.newest_camera().value();
        return view && view->camera.reason[0] != '\0';
    })) << server_.log();

    // Who comes later is told as well.
    Observer late = Observer::open(context_, "cup", "late").value();
    late.request({.target = CDIR_CHOOSE_TARGET}).value();
    EXPECT_TRUE(eventually([&] {
        late.poll().value();
        const auto view = late.newest_camera().value();
        return view && view->camera.reason[0] != '\0';
    })) << server_.log();
}

TEST_F(MatchTest, AGroupShotShowsItsPlayersTogether) {
    const Game game(context_, "cup", "hall");
    Observer observer = Observer::open(context_, "cup", "anna").value();
    EXPECT_FALSE(observer.request({.target = CDIR_SHOW_GROUP, .group = {1}}));
    observer.request({.target = CDIR_SHOW_GROUP, .group = {2, 1}}).value();
    ASSERT_TRUE(comes_to(observer, CDIR_SHOT_ACCEPTED)) << server_.log();
    const std::uint32_t own = observer.shot_status().value().camera_id;
    EXPECT_TRUE(sees(observer, [&](const auto& /*frame*/, auto cameras) {
        return std::ranges::any_of(cameras, [&](const auto& camera) {
            return camera.camera_id == own && camera.target == 2 &&
                   (camera.flags & CDIR_CAMERA_TARGET_VISIBLE) != 0;
        });
    })) << server_.log();
}

TEST_F(MatchTest, EqualRequestsShareACamera) {
    const Game game(context_, "cup", "hall");
    Observer first = Observer::open(context_, "cup", "first").value();
    Observer second = Observer::open(context_, "cup", "second").value();
    first.request({.target = 3}).value();
    second.request({.target = 3}).value();
    ASSERT_TRUE(comes_to(first, CDIR_SHOT_ACCEPTED));
    ASSERT_TRUE(comes_to(second, CDIR_SHOT_ACCEPTED));
    EXPECT_EQ(first.shot_status().value().camera_id, second.shot_status().value().camera_id);
    EXPECT_TRUE(sees(first, [](const auto& /*frame*/, auto cameras) { return cameras.size() == 1; }));
}

TEST_F(MatchTest, AMapChangeBeginsANewEpochWithACut) {
    Game game(context_, "cup", "hall");
    Observer observer = Observer::open(context_, "cup", "anna").value();
    observer.request({.target = 0}).value();
    ASSERT_TRUE(sees_own_camera(observer)) << server_.log();
    std::uint64_t before = 0;
    ASSERT_TRUE(sees(observer, [&](const auto& frame, auto /*cameras*/) {
        before = frame.epoch;
        return true;
    }));
    game.change_map("yard");
    EXPECT_TRUE(sees(observer, [&](const auto& frame, auto cameras) {
        if (frame.epoch == before || cameras.empty()) return false;
        EXPECT_GT(frame.epoch, before);
        EXPECT_TRUE((cameras[0].flags & CDIR_CAMERA_CUT) != 0 || came_late(frame))
            << "the first camera of an epoch";
        return true;
    })) << server_.log();
}

TEST_F(MatchTest, AnUnknownMapIsReportedByName) {
    const Game game(context_, "cup", "atlantis");
    Observer observer = Observer::open(context_, "cup", "anna").value();
    observer.request({.target = 0}).value();
    ASSERT_TRUE(comes_to(observer, CDIR_SHOT_WAITING_FOR_MAP)) << server_.log();
    EXPECT_THAT(observer.shot_status().value().reason, HasSubstr("atlantis"));
}

TEST_F(MatchTest, AnInvalidRequestIsRefusedWithAReason) {
    const Game game(context_, "cup", "hall");
    Observer observer = Observer::open(context_, "cup", "anna").value();
    observer.request({.target = 0, .profile = "no-such-profile"}).value();
    ASSERT_TRUE(comes_to(observer, CDIR_SHOT_REFUSED)) << server_.log();
    EXPECT_THAT(observer.shot_status().value().reason, HasSubstr("no-such-profile"));
    observer.request({.target = 0, .overrides = R"({"no_such_key": 1})"}).value();
    ASSERT_TRUE(eventually([&] {
        observer.poll().value();
        return std::string(observer.shot_status().value().reason).find("no_such_key") != std::string::npos;
    })) << server_.log();
    observer.request({.target = 0}).value();
    EXPECT_TRUE(sees_own_camera(observer));
}

TEST_F(MatchTest, TheShotOfAnObserverThatLeavesEnds) {
    const Game game(context_, "cup", "hall");
    Observer stays = Observer::open(context_, "cup", "stays").value();
    stays.request({.target = 0}).value();
    {
        Observer leaves = Observer::open(context_, "cup", "leaves").value();
        leaves.request({.target = 1}).value();
        ASSERT_TRUE(sees(stays, [](const auto& /*frame*/, auto cameras) { return cameras.size() == 2; }));
    }
    EXPECT_TRUE(sees(stays, [](const auto& /*frame*/, auto cameras) { return cameras.size() == 1; }));
}

TEST_F(MatchTest, AnObserverIsInformedThatItsMatchHasEnded) {
    std::optional<Game> game(std::in_place, context_, "cup", "hall");
    Observer observer = Observer::open(context_, "cup", "anna").value();
    observer.request({.target = 0}).value();
    ASSERT_TRUE(sees_own_camera(observer)) << server_.log();
    game.reset();
    ASSERT_TRUE(comes_to(observer, CDIR_SHOT_WAITING_FOR_MAP)) << server_.log();
    EXPECT_THAT(observer.shot_status().value().reason, HasSubstr("no game server"));
}

TEST_F(MatchTest, ARequestRightAfterAWithdrawalIsAnswered) {
    const Game game(context_, "cup", "hall");
    Observer observer = Observer::open(context_, "cup", "anna").value();
    for (int round = 0; round < 10; ++round) {
        observer.request({.target = 0}).value();
        ASSERT_TRUE(comes_to(observer, CDIR_SHOT_ACCEPTED)) << "round " << round << ": " << server_.log();
        observer.withdraw().value();
    }
}

// Written with the DDS API, because the SDK refuses to send them.
TEST_F(MatchTest, MalformedSamplesAreDroppedWithAReason) {
    RawPeer raw(domain_.id(), "raw");
    raw.write(raw_match_info("raw", 1));
    Observer observer = Observer::open(context_, "cup", "anna").value();
    const Game game(context_, "cup", "hall");
    observer.request({.target = 0}).value();
    ASSERT_TRUE(sees_own_camera(observer));

    const auto dropped = [&](RawPoseFrame frame, const std::string& reason) {
        return eventually([&] {
            raw.write(frame.sample());
            return server_.log().find("PoseFrame of match 'raw' dropped: " + reason) != std::string::npos;
        });
    };
    RawPoseFrame lengths("raw", 1, 1, 8);
    lengths.orientation.clear();
    EXPECT_TRUE(dropped(lengths, "array_length"));
    RawPoseFrame crowd("raw", 1, 2, 5000);
    EXPECT_TRUE(dropped(crowd, "too_many"));
    RawPoseFrame infinite("raw", 1, 3, 8);
    infinite.eye[5] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_TRUE(dropped(infinite, "not_finite"));
    RawPoseFrame twisted("raw", 1, 4, 8);
    twisted.orientation[2] = 7.0F;
    EXPECT_TRUE(dropped(twisted, "not_unit"));
    RawPoseFrame foreign("cup", 1, 5, 8);
    EXPECT_TRUE(dropped(foreign, "wrong_partition"));

    EXPECT_TRUE(sees_own_camera(observer)) << "the other match continues";
    EXPECT_FALSE(server_.process().wait_for(std::chrono::milliseconds(0))) << server_.log();
}

// Written with the DDS API, to leave out the one frame that declares it.
TEST_F(MatchTest, ATeleportIsACutAlsoWhenItsFrameIsLost) {
    RawPeer game(domain_.id(), "raw");
    char map_name[] = "hall";
    camera_director_MatchInfo info = raw_match_info("raw", 1);
    info.map_name = map_name;
    game.write(info);
    Observer observer = Observer::open(context_, "raw", "anna").value();
    observer.request({.target = 0}).value();

    std::uint32_t number = 0;
    float place = 0.0F;
    std::uint32_t discontinuities = 3;
    // Plays on until a camera frame is `wanted`.
    const auto play_until = [&](const auto& wanted) {
        std::array<camera_director::Camera, CDIR_MAX_CAMERAS> cameras;
        return eventually([&] {
            RawPoseFrame frame("raw", 1, ++number, 1);
            frame.eye = {place, 0.0F, 0.0F};
            frame.discontinuities = {discontinuities};
            game.write(frame.sample());
            while (const auto taken = observer.next_frame(cameras).value())
                if (taken->camera_count > 0 && wanted(*taken, cameras[0])) return true;
            return false;
        });
    };
    ASSERT_TRUE(play_until([](const auto& frame, const auto& /*camera*/) { return frame.frame_number > 20; }))
        << server_.log();

    const std::uint32_t lost = ++number;
    place = 500.0F;
    ++discontinuities;
    int frames = 0;
    EXPECT_TRUE(play_until([&](const auto& frame, const auto& camera) {
        if (frame.pose_number < lost) return false;
        EXPECT_EQ((camera.flags & CDIR_CAMERA_CUT) != 0, frames == 0) << frame.pose_number - lost;
        return ++frames == 5;
    }));
}

TEST_F(MatchTest, SigtermDrainsAndWithdrawsTheStatuses) {
    const Game game(context_, "cup", "hall");
    Observer observer = Observer::open(context_, "cup", "anna").value();
    observer.request({.target = 0}).value();
    ASSERT_TRUE(sees_own_camera(observer));
    server_.process().send_signal(SIGTERM);
    EXPECT_EQ(server_.process().wait_for(patience), 0) << server_.log();
    EXPECT_TRUE(comes_to(observer, CDIR_SHOT_UNANSWERED));
    EXPECT_TRUE(eventually([&] { return observer.counters().value().directors == 0; }));
}

}  // namespace
}  // namespace camdir::test
