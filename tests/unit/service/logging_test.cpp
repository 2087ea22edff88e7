#include "service/logging.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <spdlog/spdlog.h>

#include <string>

namespace camdir::service {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

// What is logged at the level "error" by one who logs more errors than fit into seconds, and a critical line.
std::string flooded_log() {
    testing::internal::CaptureStderr();
    start_logging({.level = "error", .format = "text"});
    for (int i = 0; i < 1000; ++i)
        spdlog::error("line {};", i);
    spdlog::critical("the end");
    return testing::internal::GetCapturedStderr();
}

TEST(Logging, LeavesLinesOutAndSaysSoAtOnce) {
    const std::string log = flooded_log();
    EXPECT_THAT(log, HasSubstr("error: line 199;\n"));
    EXPECT_THAT(log, Not(HasSubstr("error: line 999;\n")));
    EXPECT_THAT(log, HasSubstr(" lines left out: more than 200 in a second\n"));
    EXPECT_THAT(log, HasSubstr("critical: the end\n"));
}

TEST(Logging, WhatIsLeftOutIsToldAtALevelThatIsWanted) {
    const std::string log = flooded_log();
    EXPECT_THAT(log, ContainsRegex("critical: [0-9]+ lines left out"));
    EXPECT_THAT(log, Not(HasSubstr("warning")));
}

TEST(Logging, NamesFromOutsideStayOnTheirLineAsUtf8) {
    testing::internal::CaptureStderr();
    start_logging({.level = "error", .format = "text"});
    spdlog::error("observer {} of caf\u00e9", "a\xff\nb");
    EXPECT_THAT(testing::internal::GetCapturedStderr(), HasSubstr("error: observer a??b of caf\u00e9\n"));
}

}  // namespace
}  // namespace camdir::service
