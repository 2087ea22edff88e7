#include "observer.hpp"

#include <gtest/gtest.h>

namespace camdir::sdk {
namespace {

TEST(Reminder, IsDueAgainAndAgainUntilThereIsAnAnswer) {
    Reminder reminder;
    reminder.asked(7 * Reminder::interval);
    EXPECT_FALSE(reminder.due(false, 8 * Reminder::interval - 1));
    EXPECT_TRUE(reminder.due(false, 8 * Reminder::interval));
    reminder.asked(8 * Reminder::interval);
    EXPECT_FALSE(reminder.due(false, 9 * Reminder::interval - 1));
    EXPECT_TRUE(reminder.due(false, 9 * Reminder::interval));
    EXPECT_FALSE(reminder.due(true, 10 * Reminder::interval));
}

TEST(Reminder, ALostAnswerIsWaitedForFromItsLoss) {
    Reminder reminder;
    reminder.asked(0);
    EXPECT_FALSE(reminder.due(true, 5 * Reminder::interval));
    EXPECT_FALSE(reminder.due(false, 6 * Reminder::interval - 1));
    EXPECT_TRUE(reminder.due(false, 6 * Reminder::interval));
}

}  // namespace
}  // namespace camdir::sdk
