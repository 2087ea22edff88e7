extern "C" {
#include "exchange.h"
}

#include <gtest/gtest.h>

#include <memory>
#include <thread>

namespace camdir::halflife {
namespace {

struct Destroy {
    void operator()(exchange* exchange) const { exchange_destroy(exchange); }
};
using Exchange = std::unique_ptr<exchange, Destroy>;

TEST(HalfLifeExchange, HandsMessagesOverInOrder) {
    const Exchange exchange(exchange_create());
    EXPECT_EQ(exchange_next(exchange.get()), nullptr);
    const auto match = std::make_unique<match_state>();
    match->life = 7;
    const auto frame = std::make_unique<server_frame>();
    frame->frame_time = 11;
    ASSERT_TRUE(exchange_send_match(exchange.get(), match.get()));
    ASSERT_TRUE(exchange_send_frame(exchange.get(), frame.get()));
    ASSERT_TRUE(exchange_send_end(exchange.get()));
    EXPECT_EQ(exchange_next(exchange.get())->kind, message_match);
    EXPECT_EQ(exchange_next(exchange.get())->match.life, 7U);
    exchange_release(exchange.get());
    EXPECT_EQ(exchange_next(exchange.get())->kind, message_frame);
    EXPECT_EQ(exchange_next(exchange.get())->frame.frame_time, 11);
    exchange_release(exchange.get());
    EXPECT_EQ(exchange_next(exchange.get())->kind, message_end);
    exchange_release(exchange.get());
    EXPECT_EQ(exchange_next(exchange.get()), nullptr);
}

TEST(HalfLifeExchange, FramesLeaveRoomForTheOtherMessages) {
    const Exchange exchange(exchange_create());
    const auto match = std::make_unique<match_state>();
    const auto frame = std::make_unique<server_frame>();
    int frames = 0;
    while (exchange_send_frame(exchange.get(), frame.get()))
        ++frames;
    EXPECT_EQ(frames, 60);
    int matches = 0;
    while (exchange_send_match(exchange.get(), match.get()))
        ++matches;
    EXPECT_EQ(matches, 3);
    EXPECT_TRUE(exchange_send_end(exchange.get()));
    EXPECT_FALSE(exchange_send_end(exchange.get()));
    exchange_release(exchange.get());
    EXPECT_TRUE(exchange_send_end(exchange.get())) << "a released place is free again";
}

TEST(HalfLifeExchange, NothingIsLostOrTornBetweenTwoThreads) {
    const Exchange exchange(exchange_create());
    constexpr std::int64_t count = 5'000;
    std::thread writer([&] {
        const auto frame = std::make_unique<server_frame>();
        for (std::int64_t i = 0; i < count; ++i) {
            frame->frame_time = i;
            frame->event_count = static_cast<std::uint32_t>(i);
            while (!exchange_send_frame(exchange.get(), frame.get()))
                std::this_thread::yield();
        }
    });
    for (std::int64_t i = 0; i < count;) {
        const message* message = exchange_next(exchange.get());
        if (message == nullptr) {
            std::this_thread::yield();
            continue;
        }
        EXPECT_EQ(message->frame.frame_time, i);
        EXPECT_EQ(message->frame.event_count, i);
        exchange_release(exchange.get());
        ++i;
    }
    writer.join();
}

}  // namespace
}  // namespace camdir::halflife
