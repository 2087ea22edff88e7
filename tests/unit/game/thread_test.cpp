#include "game/thread.h"

#include <gtest/gtest.h>

#include <csignal>
#include <thread>

namespace camdir::game {
namespace {

struct Seen {
    int runs = 0;
    bool takes_signals = true;
};

void run(void* argument) {
    auto* seen = static_cast<Seen*>(argument);
    sigset_t blocked;
    pthread_sigmask(SIG_BLOCK, nullptr, &blocked);
    seen->takes_signals = sigismember(&blocked, SIGTERM) == 0 || sigismember(&blocked, SIGINT) == 0;
    while (!worker_thread_must_stop()) {
        std::this_thread::yield();
    }
    ++seen->runs;
}

TEST(WorkerThread, RunsUntilItIsStoppedAndMayBeStartedAgain) {
    worker_thread_stop();
    Seen seen;
    for (int i = 1; i <= 3; ++i) {
        ASSERT_TRUE(worker_thread_start(run, &seen));
        worker_thread_stop();
        EXPECT_EQ(seen.runs, i);
        worker_thread_stop();
    }
}

TEST(WorkerThread, LeavesSignalsToTheServer) {
    Seen seen;
    sigset_t before, after;
    pthread_sigmask(SIG_BLOCK, nullptr, &before);
    ASSERT_TRUE(worker_thread_start(run, &seen));
    worker_thread_stop();
    EXPECT_FALSE(seen.takes_signals);
    pthread_sigmask(SIG_BLOCK, nullptr, &after);
    EXPECT_EQ(sigismember(&after, SIGTERM), sigismember(&before, SIGTERM));
}

}  // namespace
}  // namespace camdir::game
