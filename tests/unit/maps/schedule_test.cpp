#include "maps/schedule.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace camdir::maps {
namespace {

using testing::ElementsAre;

std::vector<std::size_t> start_all(BakeSchedule& schedule) {
    std::vector<std::size_t> started;
    while (const auto job = schedule.start())
        started.push_back(*job);
    return started;
}

TEST(BakeSchedule, StartsTheLargestNeedsThatFitIntoTheBudget) {
    BakeSchedule schedule({30, 50, 40, 20}, 100, 4);
    EXPECT_THAT(start_all(schedule), ElementsAre(1, 2)) << "50 + 40 leave no room for 30 or 20";
    schedule.finish(2);
    EXPECT_THAT(start_all(schedule), ElementsAre(0, 3)) << "50 + 30 + 20 fill it";
    EXPECT_TRUE(schedule.all_started());
    EXPECT_EQ(schedule.running(), 3U);
}

TEST(BakeSchedule, RunsAJobAboveTheBudgetAlone) {
    BakeSchedule schedule({10, 500, 10, 101}, 100, 4);
    EXPECT_THAT(start_all(schedule), ElementsAre(1));
    schedule.finish(1);
    EXPECT_THAT(start_all(schedule), ElementsAre(3));
    schedule.finish(3);
    EXPECT_THAT(start_all(schedule), ElementsAre(0, 2));
}

TEST(BakeSchedule, KeepsToItsSlotsAndBreaksTiesByOrder) {
    BakeSchedule schedule({7, 7, 7}, 1000, 2);
    EXPECT_THAT(start_all(schedule), ElementsAre(0, 1));
    EXPECT_FALSE(schedule.all_started());
    schedule.finish(0);
    EXPECT_THAT(start_all(schedule), ElementsAre(2));
}

TEST(BakeSchedule, WithoutJobsAllAreStarted) {
    BakeSchedule schedule({}, 100, 2);
    EXPECT_TRUE(schedule.all_started());
    EXPECT_FALSE(schedule.start());
}

TEST(BakeSchedule, HoldsItsLimitsForRandomJobs) {
    std::mt19937 random(7);
    for (int round = 0; round < 300; ++round) {
        constexpr std::uint64_t budget = 100;
        std::vector<std::uint64_t> needs(random() % 20);
        for (std::uint64_t& need : needs)
            need = random() % 150;
        const std::size_t slots = 1 + random() % 4;
        BakeSchedule schedule(needs, budget, slots);
        std::vector<std::size_t> running;
        std::vector<int> times_started(needs.size());
        while (!schedule.all_started() || !running.empty()) {
            for (const std::size_t job : start_all(schedule)) {
                ++times_started[job];
                running.push_back(job);
            }
            ASSERT_FALSE(running.empty()) << "waits although no job runs, round " << round;
            ASSERT_LE(running.size(), slots);
            std::uint64_t used = 0;
            for (const std::size_t job : running)
                used += needs[job];
            ASSERT_TRUE(used <= budget || running.size() == 1) << "round " << round;
            const std::size_t ends = random() % running.size();
            schedule.finish(running[ends]);
            running.erase(running.begin() + static_cast<std::ptrdiff_t>(ends));
        }
        EXPECT_TRUE(std::all_of(times_started.begin(), times_started.end(), [](int n) { return n == 1; }));
    }
}

}  // namespace
}  // namespace camdir::maps
