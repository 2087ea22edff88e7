#include "director/follower.hpp"

#include <gtest/gtest.h>

#include "camera/camera.hpp"
#include "stage.hpp"

namespace camdir::director {
namespace {

// One shot, whose camera is followed.
class FollowerTest : public testing::Test {
  protected:
    static constexpr std::uint32_t camera_id = 7;

    explicit FollowerTest(std::uint32_t target = no_player) {
        shot_.key.target = target;
        shot_.camera_id = camera_id;
        shot_.automatic.player = 1;
    }

    static ShotCamera camera(std::uint32_t target, std::uint32_t flags = 0) {
        ShotCamera camera;
        camera.camera_id = camera_id;
        camera.target = target;
        camera.flags = flags;
        return camera;
    }
    // Frames of poses that are 50 ms apart.
    static CameraFrame frame(std::uint32_t pose_number, const ShotCamera& camera) {
        return {1, 0, pose_number, 50 * ms * pose_number, 0, {camera}, {}};
    }
    void compute(std::uint32_t pose_number, const ShotCamera& camera) {
        follower_.next_own() = frame(pose_number, camera);
    }
    void hear(CameraFrame shown) { follower_.hear(shown); }
    void follow() { follower_.follow({shots_, map_, false}); }

    const freespace::Freespace map_ = Stage::square();
    std::vector<Shot> shots_ = std::vector<Shot>(1);
    Shot& shot_ = shots_.front();
    Follower follower_;
};

TEST_F(FollowerTest, TakesATargetOverOnceTheSamePoseIsThere) {
    compute(1, camera(1));
    hear(frame(2, camera(3)));
    follow();
    EXPECT_EQ(shot_.automatic.player, 1U);
    compute(2, camera(1));
    follow();
    EXPECT_EQ(shot_.automatic.player, 3U);
    EXPECT_EQ(shot_.automatic.since, 100 * ms);
    shot_.automatic.player = 2;
    follow();
    EXPECT_EQ(shot_.automatic.player, 2U) << "once";
}

TEST_F(FollowerTest, ComparesNothingThatWasComputedBeforeACorrection) {
    compute(1, camera(1));
    compute(2, camera(1));
    hear(frame(1, camera(3)));
    follow();
    hear(frame(2, camera(2)));
    follow();
    EXPECT_EQ(shot_.automatic.player, 3U);
}

TEST_F(FollowerTest, TakesNothingOverFromBeforeACut) {
    compute(1, camera(1));
    compute(2, camera(2, camera::cut));
    hear(frame(1, camera(3)));
    follow();
    EXPECT_EQ(shot_.automatic.player, 1U);
}

TEST_F(FollowerTest, TellsAPlayerWhoIsAbsentFromAFixedShotThatIsUnknown) {
    compute(1, camera(1));
    hear(frame(1, camera(no_player)));
    follow();
    EXPECT_EQ(shot_.automatic.player, 1U);
    hear(frame(1, camera(no_player, camera::target_absent)));
    follow();
    EXPECT_EQ(shot_.automatic.player, no_player);
}

TEST_F(FollowerTest, TakesTheReasonOverWhereThereIsNone) {
    for (const char* why : {"kill", "flag"}) {
        compute(1, camera(1));
        CameraFrame shown = frame(1, camera(1));
        shown.reasons.push_back({camera_id, {1, 2, why}});
        hear(shown);
        follow();
        EXPECT_EQ(shot_.automatic.reason.why, "kill");
    }
}

// The tracker of a shot of player 1 goes on from the leader's camera.
class FollowerOfPlaces : public FollowerTest {
  protected:
    FollowerOfPlaces() : FollowerTest(1) {
        camera::Scratch scratch(map_);
        const PlayerPose walks = Stage::poses(1).poses.at(0);
        const camera::Pose pose{walks.eye, walks.orientation, walks.velocity, true, false};
        const camera::Camera own = camera::step(map_, shot_.profile, &pose, 0.0, shot_.state, scratch);
        own_ = camera(1);
        own_.position = own.position;
        own_.orientation = own.orientation;
        for (std::uint32_t number = 1; number <= 3; ++number)
            compute(number, own_);
    }

    // Whether the shot goes on from the leader's camera, which is nearer to the middle of the map by so much
    // than the own one of this pose.
    bool goes_on(std::uint32_t pose_number, float metres) {
        const Vec3f start = shot_.state.position;
        ShotCamera shown = own_;
        const Vec3f inwards = (map_.bounds().center() - own_.position).normalized();
        shown.position += metres / map_.metadata().metres_per_unit * inwards;
        hear(frame(pose_number - 1, shown));
        hear(frame(pose_number, shown));
        follow();
        return shot_.state.position != start;
    }

    ShotCamera own_;
};

TEST_F(FollowerOfPlaces, GoesOnFromTheLeadersWhereTheTwoDiffer) {
    EXPECT_FALSE(goes_on(3, 0.01F));
    EXPECT_TRUE(goes_on(3, 0.015F));
}

TEST_F(FollowerOfPlaces, FollowsAGuessOnlyWhereItIsElsewhere) {
    EXPECT_FALSE(goes_on(2, 0.2F));
    EXPECT_TRUE(goes_on(2, 0.3F));
}

TEST_F(FollowerOfPlaces, MakesAPreparedStepAgain) {
    shot_.is_prepared = true;
    EXPECT_TRUE(goes_on(3, 0.3F));
    EXPECT_FALSE(shot_.is_prepared);
}

}  // namespace
}  // namespace camdir::director
