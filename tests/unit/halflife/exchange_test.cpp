extern "C" {
#include "exchange.h"
}

#include <gtest/gtest.h>

#include <memory>

namespace camdir::halflife {
namespace {

TEST(HalfLifeExchange, HandsMessagesOverInOrder) {
    const std::unique_ptr<ring, decltype(&ring_destroy)> exchange(exchange_create(), &ring_destroy);
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
    ring_release(exchange.get());
    EXPECT_EQ(exchange_next(exchange.get())->kind, message_frame);
    EXPECT_EQ(exchange_next(exchange.get())->frame.frame_time, 11);
    ring_release(exchange.get());
    EXPECT_EQ(exchange_next(exchange.get())->kind, message_end);
    ring_release(exchange.get());
    EXPECT_EQ(exchange_next(exchange.get()), nullptr);
}

}  // namespace
}  // namespace camdir::halflife
