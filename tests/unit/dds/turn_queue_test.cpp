#include "dds/turn_queue.hpp"

#include <gtest/gtest.h>

#include <map>
#include <thread>
#include <vector>

namespace camdir::dds {
namespace {

using namespace std::chrono_literals;
using Clock = TurnQueue::Clock;

class TurnQueueTest : public testing::Test {
  protected:
    // Whose turns came until `end`, where each match has so many steps left.
    std::vector<std::string> turns(std::map<std::string, int>& steps,
                                   Clock::time_point end = Clock::now() + 1h) {
        std::vector<std::string> taken;
        some_are_left_ = queue_.take_turns(end, [&](const std::string& match_id) {
            taken.push_back(match_id);
            return --steps[match_id] > 0;
        });
        return taken;
    }

    TurnQueue queue_;
    bool some_are_left_ = false;
};

TEST_F(TurnQueueTest, MatchesTakeTurnsUntilEachIsDone) {
    for (const char* match_id : {"a", "b", "a", "c"})
        queue_.add(match_id);
    std::map<std::string, int> steps = {{"a", 3}, {"b", 1}, {"c", 2}};
    EXPECT_EQ(turns(steps), (std::vector<std::string>{"a", "b", "c", "a", "c", "a"}));
    EXPECT_FALSE(some_are_left_);
    queue_.add("a");
    EXPECT_EQ(turns(steps), std::vector<std::string>{"a"}) << "it may come again";
}

TEST_F(TurnQueueTest, WhatIsLeftAfterTheTimeGoesOnWhereItStopped) {
    queue_.add("a");
    queue_.add("b");
    std::map<std::string, int> steps = {{"a", 2}, {"b", 1}};
    bool some_are_left = true;
    while (steps["a"] == 2) {  // the time may be over before the first
        const auto end = Clock::now() + 10ms;
        some_are_left = queue_.take_turns(end, [&](const std::string& match_id) {
            std::this_thread::sleep_until(end);
            return --steps[match_id] > 0;
        });
    }
    EXPECT_TRUE(some_are_left);
    EXPECT_EQ(turns(steps), (std::vector<std::string>{"b", "a"}));
}

TEST_F(TurnQueueTest, IsDueAfterAPauseAndOnlyWhereAMatchWaits) {
    EXPECT_EQ(queue_.due(), Clock::time_point::max());
    queue_.add("a");
    EXPECT_LE(queue_.due(), Clock::now());
    const auto then = Clock::now() + 1h;
    queue_.pause_until(then);
    EXPECT_EQ(queue_.due(), then);
    std::map<std::string, int> steps;
    turns(steps);
    EXPECT_EQ(queue_.due(), Clock::time_point::max());
}

}  // namespace
}  // namespace camdir::dds
