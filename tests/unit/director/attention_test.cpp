#include "director/attention.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace camdir::director {
namespace {

constexpr std::int64_t second = 1'000'000'000;

class AttentionTest : public testing::Test {
  protected:
    AttentionTest() {
        for (const std::uint32_t id : {1U, 2U, 3U})
            poses_.push_back({id, Vec3f::Zero(), Quatf::Identity(), Vec3f::Zero(), pose_alive});
    }

    std::uint32_t choose(std::int64_t now, std::vector<std::uint32_t> group = {}) {
        roster_.update(poses_, 10);
        attention_.choose(target_, group, poses_, roster_, rules_, now);
        return target_.player;
    }
    void kill(std::uint32_t actor, std::int64_t at) {
        attention_.record({1, at, 1, actor, no_player, 0.0F}, rules_.automatic_half_life_s);
    }

    config::Matches rules_;
    Roster roster_;
    Attention attention_;
    std::vector<PlayerPose> poses_;
    AutomaticTarget target_;
};

TEST_F(AttentionTest, BeginsWithTheHighestScoreThenTheLowestId) {
    EXPECT_EQ(choose(0), 1U);
    target_ = {};
    kill(3, 0);
    EXPECT_EQ(choose(0), 3U);
}

TEST_F(AttentionTest, AnItemCountsLessThanAKillAndARoundNothing) {
    const auto record = [&](std::uint32_t kind, std::uint32_t actor) {
        attention_.record({.epoch = 1, .kind = kind, .actor = actor}, rules_.automatic_half_life_s);
    };
    record(8, 2);
    EXPECT_EQ(choose(0), 1U);
    target_ = {};
    record(7, 3);
    EXPECT_EQ(choose(0), 3U);
    target_ = {};
    record(1, 2);
    EXPECT_EQ(choose(0), 2U);
}

TEST_F(AttentionTest, DamageCountsByItsHitPoints) {
    const auto hurt = [&](std::uint32_t actor, float hit_points) {
        attention_.record({.epoch = 1, .kind = 5, .actor = actor, .value = hit_points},
                          rules_.automatic_half_life_s);
    };
    hurt(3, 0.0F);
    EXPECT_EQ(choose(0), 3U) << "hit points that are not known count";
    target_ = {};
    hurt(2, 51.0F);
    EXPECT_EQ(choose(0), 2U);
    target_ = {};
    hurt(3, 49.0F);
    hurt(2, -1e30F);
    EXPECT_EQ(choose(0), 2U) << "what makes no sense counts as not known";
    target_ = {};
    target_ = {};
    hurt(1, 3e38F);
    EXPECT_EQ(choose(0), 2U) << "a hundred hit points are the most that count";
    kill(1, 0);
    target_ = {};
    EXPECT_EQ(choose(0), 1U);
}

TEST_F(AttentionTest, KeepsATargetForTheHold) {
    EXPECT_EQ(choose(0), 1U);
    kill(2, 0);
    kill(2, 0);
    kill(2, 0);
    EXPECT_EQ(choose(4 * second), 1U);
    EXPECT_EQ(choose(6 * second), 2U);
}

TEST_F(AttentionTest, ChangesOnlyForALead) {
    kill(1, 0);
    EXPECT_EQ(choose(0), 1U);
    kill(1, 60 * second);
    kill(2, 60 * second);
    EXPECT_EQ(choose(60 * second), 1U) << "equal";
    kill(2, 60 * second);
    EXPECT_EQ(choose(61 * second), 1U) << "the lead has decayed below one kill";
    kill(2, 61 * second);
    EXPECT_EQ(choose(61 * second), 2U);
}

TEST_F(AttentionTest, ScoresDecay) {
    kill(2, 0);
    kill(2, 0);
    kill(3, 30 * second);
    EXPECT_EQ(choose(30 * second), 3U) << "two kills three half-lives ago are worth a quarter of one";
}

TEST_F(AttentionTest, StaysWithADeathThenChoosesTheLiving) {
    EXPECT_EQ(choose(0), 1U);
    poses_[0].flags = 0;
    EXPECT_EQ(choose(1 * second), 1U);
    EXPECT_EQ(choose(2 * second), 1U);
    EXPECT_EQ(choose(3 * second), 2U) << "whatever the hold";
}

TEST_F(AttentionTest, StaysWithTheDeadWhenAllAre) {
    EXPECT_EQ(choose(0), 1U);
    for (PlayerPose& pose : poses_)
        pose.flags = 0;
    EXPECT_EQ(choose(1 * second), 1U);
    EXPECT_EQ(choose(9 * second), 1U);
}

TEST_F(AttentionTest, LeavesAnAbsentPlayerAtOnce) {
    EXPECT_EQ(choose(0), 1U);
    poses_.erase(poses_.begin());
    EXPECT_EQ(choose(1), 2U);
    poses_[0].flags |= pose_spectator;
    EXPECT_EQ(choose(2), 3U);
    poses_.clear();
    EXPECT_EQ(choose(3), 3U) << "nobody else is there";
}

TEST_F(AttentionTest, ChoosesWithinTheGroup) {
    kill(1, 0);
    EXPECT_EQ(choose(0, {2, 3}), 2U);
    kill(1, 20 * second);
    kill(3, 20 * second);
    kill(3, 20 * second);
    EXPECT_EQ(choose(20 * second, {2, 3}), 3U);
    EXPECT_EQ(choose(20 * second, {99}), 3U) << "nobody of the group is there";
}

TEST_F(AttentionTest, SurvivesAnyClock) {
    constexpr auto least = std::numeric_limits<std::int64_t>::min();
    constexpr auto most = std::numeric_limits<std::int64_t>::max();
    kill(2, most);
    kill(2, least);
    EXPECT_EQ(choose(least), 2U);
    EXPECT_EQ(choose(most), 2U);
}

TEST_F(AttentionTest, ScoresABoundedNumberOfPlayers) {
    for (std::uint32_t player = 100; player < 100'000; ++player)
        kill(player, player * second);
    kill(2, 99'999 * second);
    kill(2, 99'999 * second);
    EXPECT_EQ(choose(99'999 * second), 2U);
}

}  // namespace
}  // namespace camdir::director
