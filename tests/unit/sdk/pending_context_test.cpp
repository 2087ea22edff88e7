// What calls say while a context is being opened, and afterwards.
#include "pending_context.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <future>
#include <memory>
#include <string>

#include "failure.hpp"

namespace camdir::sdk {
namespace {

template <class Call>
Failure failure_of(const Call& call) {
    try {
        (void)call();
        return {CDIR_OK, ""};
    } catch (const Failure& failure) {
        return failure;
    }
}

TEST(PendingContext, IsBusyUntilItsAttemptHasEnded) {
    std::promise<void> released;
    const PendingContext pending([&]() -> std::shared_ptr<const Context> {
        released.get_future().wait();
        return nullptr;  // stands for a context
    });
    EXPECT_EQ(pending.wait(0), CDIR_TIMEOUT);
    EXPECT_EQ(pending.wait(1'000'000), CDIR_TIMEOUT);
    EXPECT_EQ(failure_of([&] { return pending.get(); }).status, CDIR_BUSY);
    released.set_value();
    EXPECT_EQ(pending.wait(-1), CDIR_OK);
    EXPECT_EQ(pending.wait(0), CDIR_OK);
    EXPECT_EQ(failure_of([&] { return pending.get(); }).status, CDIR_OK);
}

TEST(PendingContext, SaysWhyItCouldNotBeOpenedAsOftenAsAsked) {
    const PendingContext pending([]() -> std::shared_ptr<const Context> {
        throw Failure{CDIR_NETWORK, "no such host"};
    });
    for (int i = 0; i < 2; ++i) {
        const Failure failure = failure_of([&] { return pending.wait(INT64_MAX); });
        EXPECT_EQ(failure.status, CDIR_NETWORK);
        EXPECT_EQ(failure.text, "no such host");
        EXPECT_EQ(failure_of([&] { return pending.get(); }).text, "no such host");
        EXPECT_EQ(pending.result(), nullptr);
    }
}

TEST(PendingContext, ItsEndWaitsForTheAttempts) {
    std::atomic<bool> ended{false};
    std::promise<void> begun;
    {
        const PendingContext pending([&]() -> std::shared_ptr<const Context> {
            begun.set_value();
            ended = true;
            return nullptr;
        });
        begun.get_future().wait();
    }
    EXPECT_TRUE(ended);
}

}  // namespace
}  // namespace camdir::sdk
