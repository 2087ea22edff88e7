#include "http/kept_answer.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

namespace camdir::http {
namespace {

using std::chrono::milliseconds;

TEST(KeptAnswer, IsMadeAnewOnlyWhenItIsTooOld) {
    int made = 0;
    KeptAnswer answer([&] { return std::to_string(++made); }, milliseconds(1000));
    const KeptAnswer::Clock::time_point start;
    EXPECT_EQ(answer.at(start), "1");
    EXPECT_EQ(answer.at(start + milliseconds(999)), "1");
    EXPECT_EQ(answer.at(start + milliseconds(1000)), "2");
    EXPECT_EQ(answer.at(start + milliseconds(1500)), "2");
    EXPECT_EQ(made, 2);
}

TEST(KeptAnswer, IsAskedForAgainWhereItCouldNotBeMade) {
    int asked = 0;
    KeptAnswer answer(
        [&]() -> std::string {
            if (++asked == 1) throw std::runtime_error("busy");
            return "made";
        },
        milliseconds(1000));
    const KeptAnswer::Clock::time_point start;
    EXPECT_THROW((void)answer.at(start), std::runtime_error);
    EXPECT_EQ(answer.at(start), "made");
}

}  // namespace
}  // namespace camdir::http
