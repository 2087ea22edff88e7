#include "base/lazy.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <thread>
#include <vector>

namespace camdir {
namespace {

TEST(Lazy, IsMadeOnceForAllThreads) {
    const Lazy<int> number{};
    std::atomic<int> made = 0;
    std::vector<const int*> seen(4);
    {
        std::vector<std::jthread> threads;
        for (const int*& place : seen)
            threads.emplace_back([&] { place = &number.get([&] { return 40 + ++made; }); });
    }
    EXPECT_EQ(made, 1);
    for (const int* place : seen) {
        EXPECT_EQ(place, seen[0]);
        EXPECT_EQ(*place, 41);
    }
}

TEST(Lazy, IsTriedAgainAfterAFailure) {
    const Lazy<int> number{};
    EXPECT_THROW((void)number.get([]() -> int { throw std::runtime_error("not yet"); }), std::runtime_error);
    EXPECT_EQ(number.get([] { return 7; }), 7);
    EXPECT_EQ(number.get([] { return 8; }), 7);
}

}  // namespace
}  // namespace camdir
