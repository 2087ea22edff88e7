// A failing request for a shot; all else needs a director.
#include "shots.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>

#include "support/test_domain.hpp"

namespace camdir::openarena {
namespace {

constexpr std::int64_t ns_per_s = 1'000'000'000;

TEST(OpenArenaShots, AFailureIsToldAndTheRequestRepeatedAfterASecond) {
    const test::TestDomain domain;
    cdir_context_options options = cdir_context_options_default();
    options.domain = domain.id();
    cdir_context context;
    ASSERT_GE(cdir_context_open(&options, &context), 0) << cdir_last_error();
    auto all = std::make_unique<shots>();
    auto report = std::make_unique<director_report>();
    viewer_request viewers[max_slots] = {};
    viewers[8].active = 1;
    const auto reason = [&] {
        (void)shots_poll(all.get(), ~std::uint64_t{0}, 1, report.get());
        return std::string(report->shots[8].reason);
    };

    shots_request(all.get(), cdir_context{}, "cup", viewers, 5 * ns_per_s);
    EXPECT_THAT(reason(), testing::HasSubstr("the context is closed"));
    EXPECT_EQ(report->shots[8].state, CDIR_SHOT_NOT_REQUESTED);
    shots_request(all.get(), context, "cup", viewers, 6 * ns_per_s - 1);
    EXPECT_FALSE(all->slots[8].open);
    shots_request(all.get(), context, "cup", viewers, 6 * ns_per_s);
    EXPECT_EQ(reason(), "");
    EXPECT_EQ(report->shots[8].state, CDIR_SHOT_UNANSWERED);

    viewers[8].active = 0;
    shots_request(all.get(), context, "cup", viewers, 6 * ns_per_s);
    EXPECT_EQ(reason(), "");
    EXPECT_EQ(report->shots[8].state, CDIR_SHOT_NOT_REQUESTED);
    shots_close(all.get());
    EXPECT_EQ(cdir_context_close(context), CDIR_OK);
}

}  // namespace
}  // namespace camdir::openarena
