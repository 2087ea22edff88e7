#include "service/logging.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <spdlog/spdlog.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <string>

namespace camdir::service {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;
using testing::MatchesRegex;
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
    EXPECT_THAT(log, HasSubstr(" lines left out: more than 200 in a second, or nobody read them\n"));
    EXPECT_THAT(log, HasSubstr("critical: the end\n"));
}

TEST(Logging, WhatIsLeftOutIsToldAtALevelThatIsWanted) {
    const std::string log = flooded_log();
    EXPECT_THAT(log, ContainsRegex("critical: [0-9]+ lines left out"));
    EXPECT_THAT(log, Not(HasSubstr("warning")));
}

// Standard error, until the destructor, as a pipe of 16 kB.
class PipedStderr {
  public:
    PipedStderr() {
        EXPECT_EQ(::pipe2(ends_, O_CLOEXEC | O_NONBLOCK), 0);
        EXPECT_GT(::fcntl(ends_[1], F_SETPIPE_SZ, 16384), 0);
        EXPECT_EQ(::fcntl(ends_[1], F_SETFL, 0), 0) << "who writes waits";
        ::dup2(ends_[1], STDERR_FILENO);
    }
    ~PipedStderr() {
        ::dup2(before_, STDERR_FILENO);
        for (const int descriptor : {before_, ends_[0], ends_[1]})
            ::close(descriptor);
    }
    PipedStderr(const PipedStderr&) = delete;
    PipedStderr& operator=(const PipedStderr&) = delete;

    // What waits to be read.
    [[nodiscard]] std::string read() const {
        std::string text(65536, ' ');
        const ssize_t size = ::read(ends_[0], text.data(), text.size());
        text.resize(static_cast<std::size_t>(std::max<ssize_t>(size, 0)));
        return text;
    }

  private:
    int before_ = ::dup(STDERR_FILENO);
    int ends_[2] = {-1, -1};
};

TEST(Logging, NobodyWaitsForWhoeverReadsIt) {
    std::string first;
    std::string then;
    {
        const PipedStderr piped;
        start_logging({.level = "error", .format = "text"});
        for (int i = 0; i < 190; ++i)
            spdlog::error("line {} {};", i, std::string(100, '.'));
        first = piped.read();
        spdlog::error("the last");
        then = piped.read();
    }
    EXPECT_THAT(first, HasSubstr("error: line 0 "));
    EXPECT_THAT(first, Not(HasSubstr("error: line 189 ")));
    EXPECT_THAT(then, ContainsRegex("error: [0-9]+ lines left out"));
    EXPECT_THAT(then, HasSubstr("error: the last\n"));
}

TEST(Logging, LinesForTheJournalHaveTheirPriority) {
    const auto logged = [](const char* format, bool to_the_journal) {
        const PipedStderr piped;
        struct stat status {};
        EXPECT_EQ(::fstat(STDERR_FILENO, &status), 0);
        const auto inode = status.st_ino + (to_the_journal ? 0 : 1);
        const std::string stream = std::to_string(status.st_dev) + ":" + std::to_string(inode);
        ::setenv("JOURNAL_STREAM", stream.c_str(), 1);
        start_logging({.level = "info", .format = format});
        ::unsetenv("JOURNAL_STREAM");
        spdlog::info("well");
        spdlog::warn("hm");
        spdlog::error("no");
        return piped.read();
    };
    EXPECT_THAT(logged("text", true),
                MatchesRegex("<6>2.*Z info: well\n<4>2.*Z warning: hm\n<3>2.*Z error: no\n"));
    EXPECT_THAT(logged("json", true), MatchesRegex("<6>\\{.*\\}\n<4>\\{.*\\}\n<3>\\{.*\\}\n"));
    EXPECT_THAT(logged("text", false), Not(HasSubstr("<")));
}

TEST(Logging, NamesFromOutsideStayOnTheirLineAsUtf8) {
    testing::internal::CaptureStderr();
    start_logging({.level = "error", .format = "text"});
    spdlog::error("observer {} of caf\u00e9", "a\xff\nb");
    EXPECT_THAT(testing::internal::GetCapturedStderr(), HasSubstr("error: observer a??b of caf\u00e9\n"));
}

}  // namespace
}  // namespace camdir::service
