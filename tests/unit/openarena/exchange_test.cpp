#include "exchange.h"

#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <thread>

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
    auto match = std::make_unique<match_state>();
    auto frame = std::make_unique<server_frame>();
    match->life = 7;
    frame->level_time = 50;
    frame->event_count = 1;
    frame->events[0] = {CDIR_EVENT_KILL, 1, 2, 1.0F, "MOD_ROCKET"};
    ASSERT_TRUE(exchange_send_match(rings.get(), match.get()));
    ASSERT_TRUE(exchange_send_frame(rings.get(), frame.get()));
    ASSERT_TRUE(exchange_send_end(rings.get()));
    ASSERT_EQ(exchange_backlog(rings.get()), 3U);
    EXPECT_EQ(exchange_next_message(rings.get())->kind, message_match);
    EXPECT_EQ(exchange_next_message(rings.get())->match.life, 7U);
    exchange_release_message(rings.get());
    EXPECT_EQ(exchange_next_message(rings.get())->frame.events[0].subject, 2);
    exchange_release_message(rings.get());
    EXPECT_EQ(exchange_next_message(rings.get())->kind, message_end);
    exchange_release_message(rings.get());
    EXPECT_EQ(exchange_next_message(rings.get()), nullptr);
}

// The end of a life and the next match must not be lost behind frames that nobody takes.
TEST(OpenArenaExchange, FramesLeaveRoomToTheOtherMessages) {
    const Exchange rings = create();
    const auto frame = std::make_unique<server_frame>();
    const auto match = std::make_unique<match_state>();
    int sent = 0;
    while (exchange_send_frame(rings.get(), frame.get())) {
        ASSERT_LT(++sent, message_capacity);
    }
    EXPECT_GT(sent, message_capacity / 2);
    EXPECT_TRUE(exchange_send_match(rings.get(), match.get()));
    EXPECT_TRUE(exchange_send_end(rings.get()));
    EXPECT_FALSE(exchange_send_frame(rings.get(), frame.get()));
    exchange_release_message(rings.get());
    exchange_release_message(rings.get());
    exchange_release_message(rings.get());
    EXPECT_TRUE(exchange_send_frame(rings.get(), frame.get()));
}

TEST(OpenArenaExchange, TheNewestReportWinsAndStaysValid) {
    const Exchange rings = create();
    auto report = std::make_unique<director_report>();
    for (std::uint32_t i = 1; i <= 5; ++i) {
        report->directors = i;
        ASSERT_TRUE(exchange_send_report(rings.get(), report.get()));
    }
    const director_report* held = exchange_newest_report(rings.get());
    EXPECT_EQ(held->directors, 5U);
    EXPECT_EQ(exchange_newest_report(rings.get()), held);
    for (std::uint32_t i = 6; exchange_send_report(rings.get(), report.get()); ++i) {
        report->directors = i;
    }
    EXPECT_EQ(held->directors, 5U);
    EXPECT_GT(exchange_newest_report(rings.get())->directors, 5U);
}

TEST(OpenArenaExchange, TwoThreadsLoseNothingThatWasTaken) {
    constexpr std::int32_t frames = 5'000;
    const Exchange rings = create();
    std::atomic<bool> done = false;
    std::thread worker([&] {
        std::int32_t expected = 0;
        auto report = std::make_unique<director_report>();
        while (expected < frames) {
            const message* next = exchange_next_message(rings.get());
            if (next == nullptr) {
                std::this_thread::yield();
                continue;
            }
            ASSERT_EQ(next->frame.level_time, expected);
            ASSERT_EQ(next->frame.players[63].health, static_cast<std::int16_t>(expected));
            ++expected;
            exchange_release_message(rings.get());
            report->epoch = static_cast<std::uint64_t>(expected);
            report->shots[63].state = static_cast<std::uint32_t>(expected);
            (void)exchange_send_report(rings.get(), report.get());
        }
        done = true;
    });
    auto frame = std::make_unique<server_frame>();
    std::uint64_t newest = 0;
    while (!done) {
        if (frame->level_time < frames && exchange_send_frame(rings.get(), frame.get())) {
            ++frame->level_time;
            frame->players[63].health = static_cast<std::int16_t>(frame->level_time);
        } else {
            std::this_thread::yield();
        }
        const director_report* report = exchange_newest_report(rings.get());
        if (report == nullptr) continue;
        ASSERT_GE(report->epoch, newest);
        ASSERT_EQ(report->shots[63].state, report->epoch);
        newest = report->epoch;
    }
    worker.join();
    EXPECT_GT(newest, 0U);
}

}  // namespace
}  // namespace camdir::openarena
