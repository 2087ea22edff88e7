#include "game/message_ring.h"

#include <gtest/gtest.h>

#include <memory>

namespace camdir::game {
namespace {

struct Message {
    message_kind kind;
    int body;
};

class MessageRing : public testing::Test {
  protected:
    bool send(message_kind kind) {
        if (message_ring_free_place(ring_.get(), kind) == nullptr) return false;
        ring_send(ring_.get());
        return true;
    }
    message_kind take() {
        const message_kind kind = static_cast<const Message*>(ring_oldest(ring_.get()))->kind;
        ring_release(ring_.get());
        return kind;
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

TEST_F(MessageRing, MessagesArriveWithTheirKind) {
    ASSERT_TRUE(send(message_match));
    ASSERT_TRUE(send(message_frame));
    ASSERT_TRUE(send(message_end));
    EXPECT_EQ(take(), message_match);
    EXPECT_EQ(take(), message_frame);
    EXPECT_EQ(take(), message_end);
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
