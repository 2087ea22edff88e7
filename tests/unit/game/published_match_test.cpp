// Over real DDS on the loopback interface, without a director.
#include "game/published_match.h"

#include <gtest/gtest.h>

#include <cstring>
#include <string>

#include "support/test_domain.hpp"

namespace camdir::game {
namespace {

class PublishedMatch : public testing::Test {
  protected:
    PublishedMatch() {
        options.domain = domain_.id();
        std::strcpy(info.match_id, "cup");
        std::strcpy(info.map_name, "oa_dm1");
    }
    ~PublishedMatch() override { published_match_close(&match); }

    bool announce(std::uint32_t life) {
        return published_match_announce(&match, &options, life, &info, nullptr, 0);
    }
    bool publishes() {
        const cdir_pose_frame frame = cdir_pose_frame_default();
        return cdir_match_publish_poses(match.handle, &frame) == CDIR_OK;
    }

    published_match match{};
    cdir_context_options options = cdir_context_options_default();
    cdir_match_info info = cdir_match_info_default();

  private:
    test::TestDomain domain_;
};

TEST_F(PublishedMatch, IsUpdatedWithinALifeAndRestartedByAnother) {
    ASSERT_TRUE(announce(1)) << cdir_last_error();
    EXPECT_TRUE(match.open && publishes());
    EXPECT_EQ(published_match_directors(&match), 0U);
    const published_match first = match;
    EXPECT_GT(first.epoch, 0U);

    info.rate_hz = 20;
    ASSERT_TRUE(announce(1)) << cdir_last_error();
    EXPECT_EQ(match.epoch, first.epoch);

    std::strcpy(info.map_name, "oa_dm3");
    ASSERT_TRUE(announce(2)) << cdir_last_error();
    EXPECT_GT(match.epoch, first.epoch);
    EXPECT_EQ(match.handle.id, first.handle.id);
    EXPECT_EQ(match.context.id, first.context.id);
}

TEST_F(PublishedMatch, IsOpenedAnewUnderAnotherNameAndWhereItIsReachedOtherwise) {
    ASSERT_TRUE(announce(1)) << cdir_last_error();
    published_match before = match;
    std::strcpy(info.match_id, "other");
    ASSERT_TRUE(announce(1)) << cdir_last_error();
    EXPECT_NE(match.context.id, before.context.id);
    EXPECT_GT(match.epoch, before.epoch);

    before = match;
    options.directors = "127.0.0.2";
    ASSERT_TRUE(announce(1)) << cdir_last_error();
    EXPECT_NE(match.context.id, before.context.id);
    EXPECT_GT(match.epoch, before.epoch);
    EXPECT_LT(cdir_context_close(before.context), 0) << "the former one is closed";
}

TEST_F(PublishedMatch, IsClosedByAFailureAndOpensAfterIt) {
    ASSERT_TRUE(announce(1)) << cdir_last_error();
    options.network_interface = "no-such-interface";
    EXPECT_FALSE(announce(1));
    EXPECT_FALSE(match.open);
    EXPECT_NE(std::string(cdir_last_error()), "");
    EXPECT_EQ(published_match_directors(&match), 0U);

    options.network_interface = "lo";
    ASSERT_TRUE(announce(1)) << cdir_last_error();
    EXPECT_TRUE(publishes());
    info.rate_hz = -1;
    EXPECT_FALSE(announce(2)) << "a match that cannot be announced";
    EXPECT_FALSE(match.open);
    published_match_close(&match);
}

}  // namespace
}  // namespace camdir::game
