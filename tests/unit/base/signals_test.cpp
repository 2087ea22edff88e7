#include "base/signals.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include "support/eventually.hpp"

namespace camdir {
namespace {

TEST(Interruption, RequestsAStopOnSigintAndSigterm) {
    for (const int number : {SIGINT, SIGTERM}) {
        const Interruption interruption;
        EXPECT_FALSE(interruption.token().stop_requested());
        ASSERT_EQ(::kill(::getpid(), number), 0);
        EXPECT_TRUE(test::eventually([&] { return interruption.token().stop_requested(); }));
    }
}

TEST(Interruption, RestoresTheSignalMask) {
    sigset_t before{};
    sigset_t after{};
    pthread_sigmask(SIG_BLOCK, nullptr, &before);
    { const Interruption interruption; }
    pthread_sigmask(SIG_BLOCK, nullptr, &after);
    for (const int number : {SIGINT, SIGTERM, SIGHUP})
        EXPECT_EQ(sigismember(&before, number), sigismember(&after, number));
}

TEST(Signals, AreQueuedForWait) {
    Signals signals;
    EXPECT_EQ(signals.wait(std::chrono::milliseconds(0)), Signal::none);
    for (const auto& [number, expected] :
         {std::pair{SIGHUP, Signal::reload}, {SIGTERM, Signal::stop}, {SIGINT, Signal::stop}}) {
        ASSERT_EQ(::kill(::getpid(), number), 0);
        EXPECT_EQ(signals.wait(std::chrono::seconds(60)), expected);
    }
}

TEST(Signals, ThoseThatNobodyWaitedForEndNothing) {
    Signals signals;
    ASSERT_EQ(::kill(::getpid(), SIGTERM), 0);
    ASSERT_EQ(::kill(::getpid(), SIGHUP), 0);
}

}  // namespace
}  // namespace camdir
