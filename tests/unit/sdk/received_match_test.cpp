#include "received_match.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "support/camera_frames.hpp"

namespace camdir::sdk {
namespace {

using test::CameraFrameArrays;
using test::ms;

CameraFrameArrays frame_of(std::uint64_t epoch, std::uint32_t number) {
    CameraFrameArrays frame{.match_id = "cup"};
    frame.epoch = epoch;
    frame.frame_number = number;
    frame.frame_time = number * 16 * ms;
    return frame;
}

camera_director_ObserverStatus status_of(std::uint64_t epoch, std::uint32_t camera_id,
                                         const std::string& observer = "anna") {
    camera_director_ObserverStatus status{};
    observer.copy(status.observer_id, 63);
    status.epoch = epoch;
    status.state = CDIR_SHOT_ACCEPTED;
    status.camera_id = camera_id;
    return status;
}

class ReceivedMatchTest : public testing::Test {
  protected:
    bool accept(CameraFrameArrays frame) { return match_.accept(frame.sample(), frame.frame_time); }

    // A frame in which the shot's camera is at x.
    bool accept(std::uint64_t epoch, std::uint32_t number, float x, std::uint32_t flags = 0,
                std::uint64_t director_id = 1) {
        CameraFrameArrays frame = frame_of(epoch, number);
        frame.director_id = director_id;
        frame.add_camera(4, -1.0F);
        frame.add_camera(5, x, flags);
        return accept(frame);
    }

    // All answers of the bucket.
    bool take(std::vector<camera_director_ObserverStatus> statuses, std::uint8_t bucket = 3) {
        camera_director_ObserverStatusBucket answers{};
        std::string("cup").copy(answers.match_id, 63);
        answers.bucket = bucket;
        answers.statuses._buffer = statuses.data();
        answers.statuses._length = static_cast<std::uint32_t>(statuses.size());
        return match_.accept(answers);
    }

    void answer(std::uint64_t epoch, std::uint32_t camera_id) {
        match_.set_requested(true);
        take({status_of(epoch, camera_id)});
    }

    // By a director.
    void describe(std::uint64_t epoch, float metres_per_unit = 1.0F, float rate_hz = 60.0F) {
        camera_director_ShownMatch info{};
        std::string("cup").copy(info.match_id, 63);
        std::string map = "oa_dm1";
        info.map_name = map.data();
        info.metres_per_unit = metres_per_unit;
        info.rate_hz = rate_hz;
        info.epoch = epoch;
        match_.accept(info);
    }

    [[nodiscard]] std::uint32_t segment() { return match_.track().newest()->segment; }

    ReceivedMatch match_{"cup", "anna", 50 * ms};
};

TEST_F(ReceivedMatchTest, CameraOfTheShotIsFoundByTheDirectorsAnswer) {
    EXPECT_TRUE(accept(1, 0, 10.0F));
    EXPECT_FALSE(match_.track().newest()) << "nothing was requested";
    answer(1, 5);
    EXPECT_TRUE(accept(1, 1, 11.0F));
    EXPECT_EQ(match_.track().newest()->camera.position[0], 11.0F);
    EXPECT_EQ(match_.track().newest()->camera.target, 105U);
}

// The director tells it in the frame of the cut.
TEST_F(ReceivedMatchTest, TheReasonOfAnAutomaticShotHoldsUntilItsTargetChanges) {
    answer(1, 5);
    EXPECT_TRUE(accept(1, 0, 10.0F));
    EXPECT_STREQ(match_.track().newest()->camera.reason, "") << "not told yet";
    EXPECT_EQ(match_.track().newest()->camera.reason_actor, CDIR_NO_PLAYER);
    CameraFrameArrays told = frame_of(1, 1);
    told.add_camera(4, -1.0F);
    told.add_camera(5, 11.0F);
    told.add_reason(4, 1, 2, "length");
    told.add_reason(5, 105, 7, "kill");
    EXPECT_TRUE(accept(told));
    EXPECT_TRUE(accept(1, 2, 12.0F));
    const cdir_camera camera = match_.track().newest()->camera;
    EXPECT_STREQ(camera.reason, "kill");
    EXPECT_EQ(camera.reason_actor, 105U);
    EXPECT_EQ(camera.reason_subject, 7U);
    EXPECT_EQ(camera.position[0], 12.0F);

    CameraFrameArrays other = frame_of(1, 3);
    other.add_camera(5, 13.0F);
    other.target.back() = 3;
    EXPECT_TRUE(accept(other));
    EXPECT_STREQ(match_.track().newest()->camera.reason, "");

    CameraFrameArrays many = frame_of(1, 4);
    many.add_camera(5, 14.0F);
    many.reasons.resize(257);
    EXPECT_FALSE(accept(many)) << "malformed";
}

TEST_F(ReceivedMatchTest, AnAnswerThatOvertakesTheDescriptionOfAnEarlierEpochIsKept) {
    answer(5, 0);  // for a match that waits for its delay, as of the newest epoch
    answer(4, 7);  // now the one before is shown
    describe(4);
    EXPECT_EQ(match_.shot_status().epoch, 4U);
    EXPECT_EQ(match_.shot_status().camera_id, 7U);
}

TEST_F(ReceivedMatchTest, AnswersToOtherObserversAreIgnored) {
    match_.set_requested(true);
    take({status_of(1, 5, "bert")});
    EXPECT_EQ(match_.shot_status().state, static_cast<std::uint32_t>(CDIR_SHOT_UNANSWERED));
    EXPECT_EQ(match_.counters().invalid, 0U);
}

TEST_F(ReceivedMatchTest, TheAnswerIsFoundAmongThoseOfItsBucketAndLostOnceOnly) {
    match_.set_requested(true);
    EXPECT_TRUE(take({status_of(1, 4, "bert")}, 3)) << "there was none";
    EXPECT_TRUE(take({status_of(1, 4, "bert"), status_of(1, 5), status_of(1, 6, "cleo")}, 3));
    EXPECT_EQ(match_.shot_status().camera_id, 5U);
    EXPECT_TRUE(take({}, 4)) << "other observers' bucket";
    EXPECT_TRUE(match_.statuses_abandoned(4));
    EXPECT_EQ(match_.shot_status().camera_id, 5U);
    EXPECT_FALSE(take({status_of(1, 4, "bert")}, 3));
    EXPECT_EQ(match_.shot_status().state, static_cast<std::uint32_t>(CDIR_SHOT_UNANSWERED));
    EXPECT_TRUE(take({}, 3)) << "it is known";
    EXPECT_TRUE(take({status_of(1, 7)}, 9)) << "of a director with other buckets";
    EXPECT_TRUE(take({}, 3));
    EXPECT_EQ(match_.shot_status().camera_id, 7U);
}

TEST_F(ReceivedMatchTest, StatusGoesFromNotRequestedToAnsweredAndBack) {
    EXPECT_EQ(match_.shot_status().state, static_cast<std::uint32_t>(CDIR_SHOT_NOT_REQUESTED));
    match_.set_requested(true);
    EXPECT_EQ(match_.shot_status().state, static_cast<std::uint32_t>(CDIR_SHOT_UNANSWERED));
    camera_director_ObserverStatus refused = status_of(1, 0);
    refused.state = CDIR_SHOT_REFUSED;
    std::string("no such profile").copy(refused.reason, 255);
    take({refused});
    EXPECT_EQ(match_.shot_status().state, static_cast<std::uint32_t>(CDIR_SHOT_REFUSED));
    EXPECT_STREQ(match_.shot_status().reason, "no such profile");
    EXPECT_FALSE(take({}));
    EXPECT_EQ(match_.shot_status().state, static_cast<std::uint32_t>(CDIR_SHOT_UNANSWERED));
    match_.set_requested(false);
    EXPECT_EQ(match_.shot_status().state, static_cast<std::uint32_t>(CDIR_SHOT_NOT_REQUESTED));
}

TEST_F(ReceivedMatchTest, TheCameraOfADirectorThatIsGoneIsFoundInTheNextOnesFrames) {
    answer(1, 5);
    EXPECT_FALSE(match_.statuses_abandoned(3));
    EXPECT_EQ(match_.shot_status().state, static_cast<std::uint32_t>(CDIR_SHOT_UNANSWERED));
    EXPECT_TRUE(accept(1, 0, 12.0F, 0, 2));
    EXPECT_EQ(match_.track().newest()->camera.position[0], 12.0F);
    take({status_of(1, 5)});
    EXPECT_EQ(match_.shot_status().state, static_cast<std::uint32_t>(CDIR_SHOT_ACCEPTED));
}

TEST_F(ReceivedMatchTest, OlderEpochsAreDroppedAndCounted) {
    describe(3);
    answer(3, 5);
    EXPECT_TRUE(accept(3, 7, 1.0F));
    EXPECT_FALSE(accept(2, 8, 2.0F));
    take({status_of(2, 4)});
    describe(2);
    EXPECT_EQ(match_.counters().stale_epoch, 3U);
    EXPECT_EQ(match_.counters().invalid, 0U);
    EXPECT_EQ(match_.track().newest()->camera.position[0], 1.0F);
    EXPECT_EQ(match_.shot_status().camera_id, 5U);
    EXPECT_EQ(match_.info()->match.epoch, 3U);
}

TEST_F(ReceivedMatchTest, AFalseEpochDoesNotSilenceTheDescribedOne) {
    constexpr std::uint64_t last = std::numeric_limits<std::uint64_t>::max();
    for (const bool known : {true, false}) {
        SCOPED_TRACE(known);
        ReceivedMatch match("cup", "anna", 50 * ms);
        std::swap(match, match_);
        if (known) describe(3);
        answer(3, 5);
        EXPECT_EQ(accept(last, 0, 1.0F), !known);
        take({status_of(last, 5)});
        describe(3);
        take({status_of(3, 5)});
        EXPECT_TRUE(accept(3, 1, 2.0F));
        EXPECT_EQ(match_.track().newest()->camera.position[0], 2.0F);
        describe(4);
        EXPECT_EQ(match_.shot_status().state, static_cast<std::uint32_t>(CDIR_SHOT_UNANSWERED));
        take({status_of(4, 5)});
        EXPECT_TRUE(accept(4, 0, 3.0F));
        EXPECT_EQ(match_.track().newest()->camera.position[0], 3.0F);
    }
}

TEST_F(ReceivedMatchTest, AnAnswerThatOvertakesItsEpochHoldsOnceThatBegins) {
    describe(3);
    answer(3, 5);
    take({status_of(4, 4)});
    EXPECT_EQ(match_.shot_status().camera_id, 5U);
    describe(4);
    EXPECT_EQ(match_.shot_status().camera_id, 4U);
    EXPECT_TRUE(accept(4, 0, 1.0F));
    EXPECT_EQ(match_.track().newest()->camera.position[0], -1.0F);
    take({status_of(5, 6)});
    EXPECT_EQ(match_.shot_status().camera_id, 4U);
    match_.match_ended();
    EXPECT_EQ(match_.shot_status().camera_id, 6U) << "the next one's description may come later";
}

TEST_F(ReceivedMatchTest, ADescriptionHoldsAfterItsDirectorsEndUntilAnotherEpochBegins) {
    describe(3);
    answer(3, 5);
    match_.info_abandoned();
    EXPECT_TRUE(accept(3, 0, 1.0F));
    EXPECT_EQ(match_.info()->match.epoch, 3U);
    EXPECT_TRUE(accept(4, 0, 1.0F)) << "the next director's may still be on its way";
    EXPECT_FALSE(match_.info());
    describe(3);
    EXPECT_EQ(match_.info()->match.epoch, 3U) << "an older epoch too";
    EXPECT_FALSE(accept(4, 1, 1.0F));
    match_.match_ended();
    EXPECT_FALSE(match_.info());
    EXPECT_TRUE(accept(4, 2, 1.0F));
}

TEST_F(ReceivedMatchTest, AFrameOfTheFarFutureDoesNotKeepOutTheNextOnes) {
    answer(1, 5);
    EXPECT_TRUE(accept(1, 0, 1.0F));
    CameraFrameArrays future = frame_of(1, 1);
    future.director_id = 1;
    future.frame_time = 3'600'000 * ms;
    future.add_camera(5, 2.0F);
    EXPECT_TRUE(accept(future));
    EXPECT_TRUE(match_.clock().at(future.frame_time));
    EXPECT_TRUE(accept(1, 2, 3.0F));
    EXPECT_EQ(match_.track().newest()->camera.position[0], 3.0F);
    EXPECT_LT(*match_.clock().at(2 * 16 * ms), 1000 * ms);
}

TEST_F(ReceivedMatchTest, NewEpochDiscardsTheOldOne) {
    answer(1, 5);
    EXPECT_TRUE(accept(1, 1000, 1.0F));
    EXPECT_TRUE(accept(2, 0, 2.0F));
    EXPECT_FALSE(match_.track().newest()) << "camera 5 of epoch 1 is not camera 5 of epoch 2";
    EXPECT_EQ(match_.shot_status().state, static_cast<std::uint32_t>(CDIR_SHOT_UNANSWERED));
    EXPECT_EQ(match_.counters().gaps, 0U);
    answer(2, 5);
    EXPECT_TRUE(accept(2, 1, 3.0F));
    EXPECT_EQ(match_.track().newest()->camera.position[0], 3.0F)
        << "an earlier frame_time is new in a new epoch";
}

TEST_F(ReceivedMatchTest, MissingFramesAreCountedAndNotInterpolatedAcross) {
    answer(1, 5);
    accept(1, 10, 1.0F);
    accept(1, 11, 2.0F);
    const std::uint32_t before = segment();
    accept(1, 15, 3.0F);
    EXPECT_EQ(match_.counters().gaps, 3U);
    EXPECT_EQ(match_.counters().frames, 3U);
    EXPECT_NE(segment(), before);
    EXPECT_EQ(match_.track().at(13 * 16 * ms)->camera.position[0], 2.0F);
}

TEST_F(ReceivedMatchTest, FrameNumbersWrapWithoutAGap) {
    answer(1, 5);
    CameraFrameArrays last = frame_of(1, std::numeric_limits<std::uint32_t>::max());
    last.frame_time = -1;
    last.add_camera(5, 1.0F);
    accept(last);
    const std::uint32_t before = segment();
    accept(1, 0, 2.0F);
    EXPECT_EQ(match_.counters().gaps, 0U);
    accept(1, 1, 2.0F);
    EXPECT_EQ(segment(), before);
}

TEST_F(ReceivedMatchTest, AnotherDirectorIsAHandOverAndNoGap) {
    answer(1, 5);
    accept(1, 100, 1.0F, 0, 1);
    const std::uint32_t before = segment();
    accept(1, 900, 2.0F, 0, 2);
    EXPECT_EQ(match_.counters().hand_overs, 1U);
    EXPECT_EQ(match_.counters().gaps, 0U);
    EXPECT_NE(segment(), before) << "the first director's last frames may have held a cut";
}

TEST_F(ReceivedMatchTest, ADirectorThatCountsOnContinuesTheShot) {
    answer(1, 5);
    accept(1, 100, 1.0F, 0, 1);
    const std::uint32_t before = segment();
    accept(1, 101, 2.0F, 0, 2);
    EXPECT_EQ(match_.counters().hand_overs, 1U);
    EXPECT_EQ(segment(), before);
    accept(1, 102, 2.0F, CDIR_CAMERA_CUT, 3);
    EXPECT_NE(segment(), before);
}

TEST_F(ReceivedMatchTest, FramesThatHaveBeenShownAreDroppedAndCounted) {
    answer(1, 5);
    accept(1, 100, 1.0F, 0, 1);
    EXPECT_TRUE(accept(1, 101, 2.0F, 0, 1));
    const std::uint32_t before = segment();
    EXPECT_FALSE(accept(1, 101, 2.5F, 0, 2)) << "by another director, which did not know";
    EXPECT_FALSE(accept(1, 100, 1.0F, 0, 1)) << "sent again by one that could not be reached";
    EXPECT_EQ(match_.counters().repeated, 2U);
    EXPECT_EQ(match_.counters().frames, 2U);
    EXPECT_EQ(match_.counters().hand_overs, 0U);
    EXPECT_TRUE(accept(1, 102, 3.0F, 0, 1));
    EXPECT_EQ(segment(), before) << "the motion goes on";
    CameraFrameArrays paused = frame_of(1, 103);
    paused.director_id = 1;
    paused.frame_time = 102 * 16 * ms;
    paused.pose_number = 1;
    EXPECT_TRUE(accept(paused)) << "the game's time stands still";
    EXPECT_FALSE(accept(paused));
    paused.frame_number = 0;
    paused.pose_number = 2;
    EXPECT_TRUE(accept(paused)) << "of a director that was started again meanwhile";
    EXPECT_TRUE(accept(2, 1, 3.0F)) << "in another epoch";
}

TEST_F(ReceivedMatchTest, CutAbsenceAndAnotherCameraBeginASegment) {
    answer(1, 5);
    accept(1, 0, 1.0F);
    const std::uint32_t first = segment();
    accept(1, 1, 2.0F, CDIR_CAMERA_CUT);
    EXPECT_EQ(segment(), first + 1);
    accept(frame_of(1, 2));  // without the camera
    accept(1, 3, 3.0F);
    EXPECT_EQ(segment(), first + 2);
    take({status_of(1, 4)});
    accept(1, 4, 4.0F);
    EXPECT_EQ(segment(), first + 3);
    EXPECT_EQ(match_.track().newest()->camera.camera_id, 4U);
}

TEST_F(ReceivedMatchTest, MalformedFramesAreDroppedAndCounted) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float infinity = std::numeric_limits<float>::infinity();
    const std::vector<std::function<void(CameraFrameArrays&)>> defects = {
        [](auto& frame) { frame.match_id = "another"; },
        [](auto& frame) { frame.frame_time = std::numeric_limits<std::int64_t>::min(); },
        [](auto& frame) { frame.frame_time = std::numeric_limits<std::int64_t>::max(); },
        [](auto& frame) { frame.camera_id.push_back(9); },
        [](auto& frame) { frame.target.clear(); },
        [](auto& frame) { frame.position.pop_back(); },
        [](auto& frame) { frame.orientation.push_back(0.0F); },
        [](auto& frame) { frame.vertical_fov.clear(); },
        [](auto& frame) { frame.clearance.clear(); },
        [](auto& frame) { frame.flags.clear(); },
        [=](auto& frame) { frame.position[1] = nan; },
        [=](auto& frame) { frame.position[2] = infinity; },
        [](auto& frame) { frame.position[0] = -1.1e9F; },
        [=](auto& frame) { frame.orientation[0] = nan; },
        [](auto& frame) { frame.orientation[3] = 1.002F; },
        [](auto& frame) { frame.orientation[3] = 0.0F; },
        [=](auto& frame) { frame.clearance[0] = nan; },
        [=](auto& frame) { frame.vertical_fov[0] = nan; },
        [](auto& frame) { frame.vertical_fov[0] = 0.0F; },
        [](auto& frame) { frame.vertical_fov[0] = 3.2F; },
        [](auto& frame) {
            for (std::uint32_t id = 10; id < 10 + CDIR_MAX_CAMERAS; ++id) {
                frame.add_camera(id, 0.0F);
            }
        },
    };
    answer(1, 5);
    ASSERT_TRUE(accept(1, 0, 1.0F));
    for (std::size_t i = 0; i < defects.size(); ++i) {
        CameraFrameArrays frame = frame_of(1, 1);
        frame.add_camera(5, 2.0F);
        defects[i](frame);
        EXPECT_FALSE(accept(frame)) << "defect " << i;
        EXPECT_EQ(match_.counters().invalid, i + 1) << "defect " << i;
    }
    EXPECT_EQ(match_.counters().frames, 1U);
    EXPECT_EQ(match_.track().newest()->camera.position[0], 1.0F);
    CameraFrameArrays full = frame_of(1, 1);
    for (std::uint32_t id = 0; id < CDIR_MAX_CAMERAS; ++id) {
        full.add_camera(id, 0.0F);
    }
    EXPECT_TRUE(accept(full)) << "as many cameras as are allowed";
}

// Random frames with wrong lengths and numbers: the camera returned is always a valid one.
TEST_F(ReceivedMatchTest, NoFrameLeavesAnInvalidCamera) {
    const unsigned seed = 3;
    std::mt19937 random(seed);
    const auto below = [&](std::uint32_t bound) { return static_cast<std::uint32_t>(random() % bound); };
    const auto any_float = [&] { return std::bit_cast<float>(static_cast<std::uint32_t>(random())); };
    answer(1, 5);
    for (std::uint32_t i = 0; i < 20'000; ++i) {
        const std::uint64_t epoch = 2 + i / 5000 - (below(10) == 0 ? 1 : 0);
        CameraFrameArrays frame = frame_of(epoch, below(1000));
        frame.frame_time = static_cast<std::int64_t>(below(50)) * ms * i / 20;
        frame.director_id = below(2);
        for (std::uint32_t n = below(4); n > 0; --n) {
            frame.add_camera(3 + n, any_float(), below(32));
        }
        if (below(4) == 0) frame.position.resize(below(12), any_float());
        if (below(4) == 0) frame.orientation.resize(below(16), 0.5F);
        if (below(8) == 0) frame.clearance.assign(frame.camera_id.size(), any_float());
        if (below(8) == 0) frame.vertical_fov.assign(frame.camera_id.size(), any_float());
        if (below(8) == 0) frame.flags.resize(below(6));
        accept(frame);
        take({status_of(epoch, 3 + below(4))});
        const auto view = match_.track().at(frame.frame_time - static_cast<std::int64_t>(below(100)) * ms);
        if (!view) continue;
        const cdir_camera& camera = view->camera;
        const float* q = camera.orientation;
        ASSERT_NEAR(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3], 1.0F, 2.1e-3F) << "step " << i;
        ASSERT_TRUE(std::isfinite(camera.clearance)) << "step " << i;
        ASSERT_TRUE(camera.vertical_fov > 0.0F && camera.vertical_fov < 3.1416F) << "step " << i;
        ASSERT_TRUE(
            std::all_of(camera.position, camera.position + 3, [](float x) { return std::isfinite(x); }))
            << "step " << i;
    }
    EXPECT_GT(match_.counters().invalid, 1000U) << "seed " << seed;
    EXPECT_GT(match_.counters().frames, 1000U) << "seed " << seed;
}

TEST_F(ReceivedMatchTest, TheLengthOfAUnitMayBeUnknown) {
    describe(3, 0.0F);
    describe(2);
    EXPECT_EQ(match_.counters().invalid, 0U);
    EXPECT_EQ(match_.counters().stale_epoch, 1U) << "the one before counts";
    describe(4, -1.0F);
    EXPECT_EQ(match_.counters().invalid, 1U);
}

TEST_F(ReceivedMatchTest, ADescriptionWithoutARateIsInvalid) {
    for (const float rate : {0.0F, -60.0F}) {
        describe(1, 1.0F, rate);
        EXPECT_FALSE(match_.info());
    }
    EXPECT_EQ(match_.counters().invalid, 2U);
}

TEST_F(ReceivedMatchTest, UnknownStateIsInvalid) {
    match_.set_requested(true);
    camera_director_ObserverStatus status = status_of(1, 5);
    status.state = 4;
    take({status});
    EXPECT_EQ(match_.counters().invalid, 1U);
    EXPECT_EQ(match_.shot_status().state, static_cast<std::uint32_t>(CDIR_SHOT_UNANSWERED));
}

}  // namespace
}  // namespace camdir::sdk
