#include "game/message_ring.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>

namespace camdir::game {
namespace {

struct Message {
    message_header header;
    union {
        std::int64_t number;
        char text[100];
    };
};

class MessageRing : public testing::Test {
  protected:
    bool send(message_kind kind, std::int64_t number = 0) {
        return message_ring_send(ring_.get(), kind, &number, kind == message_end ? 0 : sizeof number);
    }
    Message take() {
        const Message message = *static_cast<const Message*>(ring_oldest(ring_.get()));
        ring_release(ring_.get());
        return message;
    }
    int send_all(message_kind kind) {
        int sent = 0;
        while (sent <= capacity && send(kind)) {
            ++sent;
        }
        return sent;
    }

    static constexpr int capacity = 16;

  private:
    std::unique_ptr<ring, decltype(&ring_destroy)> ring_{ring_create(capacity, sizeof(Message)),
                                                         &ring_destroy};
};

TEST_F(MessageRing, MessagesArriveInOrderWithTheirKindAndBody) {
    ASSERT_TRUE(send(message_match, 7));
    ASSERT_TRUE(send(message_frame, 11));
    ASSERT_TRUE(send(message_end));
    const Message match = take(), frame = take(), end = take();
    EXPECT_EQ(match.header.kind, message_match);
    EXPECT_EQ(match.number, 7);
    EXPECT_EQ(frame.header.kind, message_frame);
    EXPECT_EQ(frame.number, 11);
    EXPECT_EQ(end.header.kind, message_end);
}

// The end of a life and the next match must not be lost behind frames that nobody takes.
TEST_F(MessageRing, FramesLeaveRoomToTheOthersAndMatchesToAnEnd) {
    EXPECT_EQ(send_all(message_frame), capacity - 4);
    EXPECT_EQ(send_all(message_match), 3);
    EXPECT_EQ(send_all(message_end), 1);
    EXPECT_FALSE(send(message_frame));
    take();
    EXPECT_FALSE(send(message_match));
    EXPECT_TRUE(send(message_end)) << "a released place is free again";
    for (int i = 0; i < 5; ++i) {
        take();
    }
    EXPECT_TRUE(send(message_frame));
}

}  // namespace
}  // namespace camdir::game
