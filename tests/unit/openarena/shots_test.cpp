// Failing requests for a shot, and lost contexts; all else needs a director.
#include "shots.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>

#include "support/test_domain.hpp"

namespace camdir::openarena {
namespace {

constexpr std::int64_t ns_per_s = 1'000'000'000;

// The spectator in slot 8 wants a camera.
class OpenArenaShots : public testing::Test {
  protected:
    OpenArenaShots() { viewers[8].active = 1; }

    cdir_context open_context() {
        cdir_context_options options = cdir_context_options_default();
        options.domain = domain.id();
        cdir_context context;
        EXPECT_GE(cdir_context_open(&options, &context), 0) << cdir_last_error();
        return context;
    }
    std::uint32_t state() {
        (void)shots_poll(all.get(), ~std::uint64_t{0}, 1, report.get());
        return report->shots[8].state;
    }

    const test::TestDomain domain;
    std::unique_ptr<shots> all = std::make_unique<shots>();
    std::unique_ptr<director_report> report = std::make_unique<director_report>();
    viewer_request viewers[max_slots] = {};
};

TEST_F(OpenArenaShots, AFailureIsToldAndTheRequestRepeatedAfterASecond) {
    const cdir_context context = open_context();
    shots_request(all.get(), context, "no/id", viewers, 5 * ns_per_s);
    EXPECT_EQ(state(), CDIR_SHOT_NOT_REQUESTED);
    EXPECT_THAT(report->shots[8].reason, testing::HasSubstr("match_id"));
    shots_request(all.get(), context, "cup", viewers, 6 * ns_per_s - 1);
    EXPECT_FALSE(all->slots[8].open);
    shots_request(all.get(), context, "cup", viewers, 6 * ns_per_s);
    EXPECT_EQ(state(), CDIR_SHOT_UNANSWERED);
    EXPECT_STREQ(report->shots[8].reason, "");

    viewers[8].active = 0;
    shots_request(all.get(), context, "cup", viewers, 6 * ns_per_s);
    EXPECT_EQ(state(), CDIR_SHOT_NOT_REQUESTED);
    EXPECT_STREQ(report->shots[8].reason, "");
    EXPECT_EQ(cdir_context_close(context), CDIR_OK);
}

TEST_F(OpenArenaShots, GoWithTheirContextAndAreRequestedAnewInTheNext) {
    cdir_context context = open_context();
    shots_request(all.get(), context, "cup", viewers, 5 * ns_per_s);
    EXPECT_EQ(state(), CDIR_SHOT_UNANSWERED);
    EXPECT_EQ(cdir_context_close(context), CDIR_OK);
    EXPECT_EQ(state(), CDIR_SHOT_NOT_REQUESTED);
    context = open_context();
    shots_request(all.get(), context, "cup", viewers, 5 * ns_per_s);
    EXPECT_EQ(state(), CDIR_SHOT_UNANSWERED);
    EXPECT_EQ(cdir_context_close(context), CDIR_OK);
}

}  // namespace
}  // namespace camdir::openarena
