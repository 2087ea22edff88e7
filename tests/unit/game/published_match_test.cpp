// Over real DDS on the loopback interface, without a director.
#include "game/published_match.h"

#include <gtest/gtest.h>

#include <cstring>
#include <string>

#include "support/test_domain.hpp"

namespace camdir::game {
namespace {

constexpr std::int64_t second = 1'000'000'000;

class PublishedMatch : public testing::Test {
  protected:
    PublishedMatch() {
        wanted.life = 1;
        wanted.settings.enabled = 1;
        wanted.settings.domain = domain_.id();
        wanted.settings.rate_hz = 60;
        std::strcpy(wanted.map, "oa_dm1");
        std::strcpy(wanted.settings.match_id, "cup");
        std::strcpy(wanted.settings.network_interface, "lo");
        std::strcpy(wanted.settings.directors, "127.0.0.1");
    }
    ~PublishedMatch() override { published_match_close(&match); }

    // Returns whether it is open then.
    bool want() {
        published_match_want(&match, &wanted, now);
        return match.open;
    }
    bool look_after(std::int64_t duration) {
        now += duration;
        published_match_look_after(&match, now);
        return match.open;
    }
    cdir_status publish(std::int64_t frame_time) {
        cdir_pose_frame frame = cdir_pose_frame_default();
        frame.frame_time = frame_time;
        return cdir_match_publish_poses(match.handle, &frame);
    }

    match_state wanted{};
    published_match match{};
    std::int64_t now = 5 * second;

  private:
    test::TestDomain domain_;
};

TEST_F(PublishedMatch, IsUpdatedWithinALifeAndRestartedByAnother) {
    ASSERT_TRUE(want()) << match.error;
    EXPECT_EQ(publish(0), CDIR_OK);
    const published_match first = match;
    EXPECT_GT(first.epoch, 0U);

    wanted.settings.rate_hz = 20;
    wanted.players[0] = {1, 2, "anna"};
    wanted.players[63] = {1, 1, "bart"};
    ASSERT_TRUE(want()) << match.error;
    EXPECT_EQ(match.epoch, first.epoch);

    std::strcpy(wanted.map, "oa_dm3");
    wanted.life = 2;
    ASSERT_TRUE(want()) << match.error;
    EXPECT_GT(match.epoch, first.epoch);
    EXPECT_EQ(match.handle.id, first.handle.id);
    EXPECT_EQ(match.context.id, first.context.id);
}

TEST_F(PublishedMatch, IsOpenedAnewUnderAnotherNameAndWhereItIsReachedOtherwise) {
    ASSERT_TRUE(want()) << match.error;
    published_match before = match;
    std::strcpy(wanted.settings.match_id, "other");
    ASSERT_TRUE(want()) << match.error;
    EXPECT_NE(match.context.id, before.context.id);
    EXPECT_GT(match.epoch, before.epoch);

    before = match;
    std::strcpy(wanted.settings.directors, "127.0.0.2");
    ASSERT_TRUE(want()) << match.error;
    EXPECT_NE(match.context.id, before.context.id);
    EXPECT_GT(match.epoch, before.epoch);
    EXPECT_LT(cdir_context_close(before.context), 0) << "the former one is closed";
}

TEST_F(PublishedMatch, IsClosedByAFailureAndOpensOnceItsCauseIsGone) {
    ASSERT_TRUE(want()) << match.error;
    std::strcpy(wanted.settings.network_interface, "no-such-interface");
    EXPECT_FALSE(want());
    EXPECT_NE(std::string(match.error).find("no-such-interface"), std::string::npos) << match.error;
    EXPECT_EQ(match.epoch, 0U);

    std::strcpy(wanted.settings.network_interface, "lo");
    ASSERT_TRUE(want()) << match.error;
    EXPECT_STREQ(match.error, "");
    EXPECT_EQ(publish(0), CDIR_OK);
    wanted.settings.rate_hz = -1;
    EXPECT_FALSE(want()) << "a match that cannot be announced";
    EXPECT_STRNE(match.error, "");
    published_match_close(&match);
}

TEST_F(PublishedMatch, IsOpenedAnewASecondAfterACallHasFailed) {
    ASSERT_TRUE(want()) << match.error;
    const published_match before = match;
    EXPECT_EQ(publish(10), CDIR_OK);
    ASSERT_EQ(publish(5), CDIR_INVALID_ARGUMENT);
    published_match_fail(&match, now);
    EXPECT_FALSE(match.open);
    EXPECT_NE(std::string(match.error).find("frame_time went back"), std::string::npos) << match.error;
    EXPECT_FALSE(look_after(second - 1));
    ASSERT_TRUE(look_after(1)) << match.error;
    EXPECT_STREQ(match.error, "");
    EXPECT_GT(match.epoch, before.epoch);
    EXPECT_EQ(publish(5), CDIR_OK);
}

TEST_F(PublishedMatch, PlayersWhoComeAndGoDoNotHastenAnotherTrial) {
    std::strcpy(wanted.settings.network_interface, "no-such-interface");
    EXPECT_FALSE(want());
    const std::int64_t due = match.retry_time;
    now += second / 2;
    wanted.players[3].in_use = 1;
    EXPECT_FALSE(want());
    EXPECT_EQ(match.retry_time, due);
    ++wanted.life;
    EXPECT_FALSE(want());
    EXPECT_EQ(match.retry_time, due + second / 2);
}

TEST_F(PublishedMatch, IsClosedWhileItsSettingsAreWrongOrItIsDisabled) {
    ASSERT_TRUE(want()) << match.error;
    std::strcpy(wanted.settings.error, "director_domain 'x': expected a number");
    EXPECT_FALSE(want());
    EXPECT_STREQ(match.error, wanted.settings.error);
    EXPECT_FALSE(look_after(10 * second));
    EXPECT_STREQ(match.error, wanted.settings.error);
    wanted.settings.enabled = 0;
    EXPECT_FALSE(want());
    EXPECT_STREQ(match.error, "");
    EXPECT_FALSE(look_after(10 * second));

    wanted.settings.enabled = 1;
    wanted.settings.error[0] = '\0';
    EXPECT_TRUE(want()) << match.error;
}

TEST_F(PublishedMatch, OutlivesAChangeOfMapOfAMinute) {
    ASSERT_TRUE(want()) << match.error;
    const published_match before = match;
    published_match_end_life(&match, now);
    EXPECT_TRUE(look_after(60 * second - 1));
    ++wanted.life;
    ASSERT_TRUE(want()) << match.error;
    EXPECT_EQ(match.context.id, before.context.id);

    published_match_end_life(&match, now);
    EXPECT_FALSE(look_after(60 * second));
    EXPECT_STREQ(match.error, "");
}

TEST_F(PublishedMatch, IsNotTriedAgainWithoutALife) {
    ASSERT_TRUE(want()) << match.error;
    published_match_fail(&match, now);
    published_match_end_life(&match, now);
    EXPECT_FALSE(look_after(2 * second));
}

}  // namespace
}  // namespace camdir::game
