#include "exchange.h"

#include <gtest/gtest.h>

#include <memory>

namespace camdir::openarena {
namespace {

using Exchange = std::unique_ptr<exchange, decltype(&exchange_destroy)>;

Exchange create() {
    return {exchange_create(), &exchange_destroy};
}

TEST(OpenArenaExchange, AnEmptyOneHoldsNothing) {
    const Exchange rings = create();
    EXPECT_EQ(exchange_next_message(rings.get()), nullptr);
    EXPECT_EQ(exchange_newest_report(rings.get()), nullptr);
    EXPECT_EQ(exchange_backlog(rings.get()), 0U);
}

TEST(OpenArenaExchange, MessagesArriveInOrderWithTheirKind) {
    const Exchange rings = create();
    auto match = std::make_unique<match_message>();
    auto frame = std::make_unique<server_frame>();
    match->state.life = 7;
    frame->level_time = 50;
    frame->event_count = 1;
    frame->events[0] = {CDIR_EVENT_KILL, 1, 2, 1.0F, "MOD_ROCKET"};
    ASSERT_TRUE(exchange_send_match(rings.get(), match.get()));
    ASSERT_TRUE(exchange_send_frame(rings.get(), frame.get()));
    ASSERT_TRUE(exchange_send_end(rings.get()));
    ASSERT_EQ(exchange_backlog(rings.get()), 3U);
    EXPECT_EQ(exchange_next_message(rings.get())->header.kind, message_match);
    EXPECT_EQ(exchange_next_message(rings.get())->match.state.life, 7U);
    exchange_release_message(rings.get());
    EXPECT_EQ(exchange_next_message(rings.get())->frame.events[0].subject, 2);
    exchange_release_message(rings.get());
    EXPECT_EQ(exchange_next_message(rings.get())->header.kind, message_end);
    exchange_release_message(rings.get());
    EXPECT_EQ(exchange_next_message(rings.get()), nullptr);
}

TEST(OpenArenaExchange, ReportsGoTheOtherWay) {
    const Exchange rings = create();
    auto report = std::make_unique<director_report>();
    for (std::uint32_t i = 1; i <= 5; ++i) {
        report->directors = i;
        ASSERT_TRUE(exchange_send_report(rings.get(), report.get()));
    }
    EXPECT_EQ(exchange_newest_report(rings.get())->directors, 5U);
    EXPECT_EQ(exchange_next_message(rings.get()), nullptr);
}

}  // namespace
}  // namespace camdir::openarena
