#include "base/log_limit.hpp"

#include <gtest/gtest.h>

namespace camdir {
namespace {

using namespace std::chrono_literals;

TEST(LogBudget, LeavesOutWhatIsMoreThanASecondsAndCountsIt) {
    LogBudget budget(2);
    const LogBudget::Time start{100s};
    EXPECT_EQ(budget.take(start), 0U);
    EXPECT_EQ(budget.take(start + 1ms), 0U);
    EXPECT_EQ(budget.take(start + 2ms), std::nullopt);
    EXPECT_EQ(budget.take(start + 999ms), std::nullopt);
    EXPECT_EQ(budget.take(start + 1s), 2U);
    EXPECT_EQ(budget.take(start + 1s), 0U);
    EXPECT_EQ(budget.take(start + 1s), std::nullopt);
    EXPECT_EQ(budget.take(start + 9s), 1U);
}

TEST(LogBudget, HasAlwaysRoomForAVitalLineWhichTellsOfWhatWasLeftOut) {
    LogBudget budget(1);
    const LogBudget::Time start{100s};
    EXPECT_EQ(budget.take(start), 0U);
    EXPECT_EQ(budget.take(start), std::nullopt);
    EXPECT_EQ(budget.take(start, true), 1U);
    EXPECT_EQ(budget.take(start, true), 0U);
    EXPECT_EQ(budget.take(start), std::nullopt) << "it takes the others' room";
    EXPECT_EQ(budget.take(start + 1s), 1U);
}

}  // namespace
}  // namespace camdir
