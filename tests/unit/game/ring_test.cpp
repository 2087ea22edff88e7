#include "game/ring.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <thread>

namespace camdir::game {
namespace {

// Every number is the same, unless the element was torn.
using Element = std::array<std::uint32_t, 250>;

Element element(std::uint32_t number) {
    Element all;
    all.fill(number);
    return all;
}

class Ring : public testing::Test {
  protected:
    bool send(std::uint32_t number, std::uint32_t spare = 0) {
        void* place = ring_free_place(ring_.get(), spare);
        if (place == nullptr) return false;
        *static_cast<Element*>(place) = element(number);
        ring_send(ring_.get());
        return true;
    }
    const Element* oldest() { return static_cast<const Element*>(ring_oldest(ring_.get())); }
    const Element* newest() { return static_cast<const Element*>(ring_newest(ring_.get())); }
    void release() { ring_release(ring_.get()); }
    std::uint32_t used() { return ring_used(ring_.get()); }

    static constexpr std::uint32_t capacity = 64;

  private:
    std::unique_ptr<ring, decltype(&ring_destroy)> ring_{ring_create(capacity, sizeof(Element)),
                                                         &ring_destroy};
};

TEST_F(Ring, AnEmptyOneHoldsNothing) {
    EXPECT_EQ(oldest(), nullptr);
    EXPECT_EQ(newest(), nullptr);
    EXPECT_EQ(used(), 0U);
    ring_destroy(nullptr);
}

TEST_F(Ring, ElementsArriveInOrderRoundAfterRound) {
    for (std::uint32_t number = 0; number < 10 * capacity; number += 3) {
        for (std::uint32_t i = 0; i < 3; ++i) {
            ASSERT_TRUE(send(number + i));
        }
        ASSERT_EQ(used(), 3U);
        for (std::uint32_t i = 0; i < 3; ++i) {
            ASSERT_EQ(*oldest(), element(number + i));
            release();
        }
        ASSERT_EQ(oldest(), nullptr);
    }
}

TEST_F(Ring, PlacesSuitAnyType) {
    for (std::uint32_t number = 0; number < capacity; ++number) {
        ASSERT_TRUE(send(number));
        EXPECT_EQ(reinterpret_cast<std::uintptr_t>(oldest()) % alignof(std::max_align_t), 0U);
        release();
    }
}

TEST_F(Ring, AFullOneTakesNothingUntilAPlaceIsReleased) {
    for (std::uint32_t number = 0; number < capacity; ++number) {
        ASSERT_TRUE(send(number));
    }
    EXPECT_FALSE(send(99));
    EXPECT_EQ(used(), capacity);
    release();
    EXPECT_TRUE(send(99));
    EXPECT_EQ(*oldest(), element(1));
}

TEST_F(Ring, SparePlacesRemainFree) {
    while (send(0, 3)) {
        ASSERT_LE(used(), capacity);
    }
    EXPECT_EQ(used(), capacity - 3);
    EXPECT_TRUE(send(0, 2));
}

TEST_F(Ring, TheNewestWinsAndStaysValid) {
    for (std::uint32_t number = 1; number <= 5; ++number) {
        ASSERT_TRUE(send(number));
    }
    const Element* held = newest();
    EXPECT_EQ(*held, element(5));
    EXPECT_EQ(newest(), held);
    std::uint32_t last = 5;
    while (send(last + 1)) {
        ++last;
    }
    EXPECT_EQ(last, 5 + capacity - 1);
    EXPECT_EQ(*held, element(5));
    EXPECT_EQ(*newest(), element(last));
}

TEST_F(Ring, NothingIsLostOrTornBetweenTwoThreads) {
    constexpr std::uint32_t count = 5'000;
    std::thread writer([&] {
        for (std::uint32_t number = 0; number < count;) {
            if (send(number)) {
                ++number;
            } else {
                std::this_thread::yield();
            }
        }
    });
    for (std::uint32_t number = 0; number < count;) {
        const Element* next = oldest();
        if (next == nullptr) {
            std::this_thread::yield();
            continue;
        }
        EXPECT_EQ(*next, element(number++));
        release();
    }
    writer.join();
}

TEST_F(Ring, TheNewestIsNeverTornNorOlderThanBefore) {
    constexpr std::uint32_t count = 20'000;
    std::atomic<bool> done = false;
    std::thread writer([&] {
        for (std::uint32_t number = 1; number <= count; ++number) {
            (void)send(number);
        }
        done = true;
    });
    std::uint32_t last = 0;
    while (!done) {
        const Element* found = newest();
        if (found == nullptr || found->front() == last) {
            std::this_thread::yield();
            continue;
        }
        EXPECT_EQ(*found, element(found->front()));
        EXPECT_GT(found->front(), last);
        last = found->front();
    }
    writer.join();
    EXPECT_GT(newest()->front(), 0U);
}

}  // namespace
}  // namespace camdir::game
