#include "director/worker_pool.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <functional>
#include <future>
#include <memory>
#include <thread>
#include <vector>

#include "support/eventually.hpp"

namespace camdir::director {
namespace {

class FunctionStrand final : public Strand {
  public:
    explicit FunctionStrand(std::function<void()> work) : work_([work](Turn& /*turn*/) { work(); }) {}
    explicit FunctionStrand(std::function<void(Turn&)> work) : work_(std::move(work)) {}

  private:
    void turn(Turn& turn) noexcept override { work_(turn); }
    std::function<void(Turn&)> work_;
};

TEST(WorkerPool, AScheduledStrandGetsATurnThatBeginsLater) {
    WorkerPool pool(2, 1);
    std::atomic<int> posted{0};
    std::atomic<int> seen{0};
    FunctionStrand strand([&] { seen = posted.load(); });
    ASSERT_TRUE(pool.attach(strand));
    for (int i = 1; i <= 10'000; ++i) {
        posted = i;
        pool.schedule(strand);
        if (i % 100 != 0) continue;
        WorkerPool::wait_idle(strand);
        ASSERT_EQ(seen, i);
    }
    pool.detach(strand);
}

TEST(WorkerPool, OneWorkerAtATimeRunsAStrand) {
    constexpr std::size_t strands = 130;  // more than two words of bits
    WorkerPool pool(8, strands);
    struct Counted {
        std::atomic<int> inside{0};
        std::atomic<bool> overlapped{false};
        int turns = 0;  // not atomic, so that the thread sanitizer reports a race
        std::unique_ptr<FunctionStrand> strand;
    };
    std::vector<Counted> counted(strands);
    for (Counted& one : counted) {
        one.strand = std::make_unique<FunctionStrand>([&one] {
            if (one.inside.fetch_add(1) != 0) one.overlapped = true;
            ++one.turns;
            one.inside.fetch_sub(1);
        });
        ASSERT_TRUE(pool.attach(*one.strand));
    }
    std::vector<std::thread> threads;
    for (int t = 0; t < 4; ++t)
        threads.emplace_back([&] {
            for (int i = 0; i < 300; ++i)
                for (Counted& one : counted)
                    pool.schedule(*one.strand);
        });
    for (std::thread& thread : threads)
        thread.join();
    for (Counted& one : counted) {
        WorkerPool::wait_idle(*one.strand);
        EXPECT_FALSE(one.overlapped);
        EXPECT_GE(one.turns, 1);
        EXPECT_LE(one.turns, 1200);
        pool.detach(*one.strand);
    }
}

TEST(WorkerPool, ABusyStrandDoesNotStarveTheOthers) {
    constexpr std::size_t others = 100;
    WorkerPool pool(1, others + 2);
    std::promise<void> release;
    FunctionStrand blocker([&] { release.get_future().wait(); });
    int busy_turns = 0;  // written by the only worker
    int turns = 0;
    int busy_turns_at_the_end = 0;
    std::unique_ptr<FunctionStrand> busy;
    busy = std::make_unique<FunctionStrand>([&] {
        ++busy_turns;
        if (turns < static_cast<int>(others)) pool.schedule(*busy);
    });
    std::vector<std::unique_ptr<FunctionStrand>> strands;
    for (std::size_t i = 0; i < others; ++i)
        strands.push_back(std::make_unique<FunctionStrand>([&] {
            if (++turns == static_cast<int>(others)) busy_turns_at_the_end = busy_turns;
        }));
    ASSERT_TRUE(pool.attach(blocker));
    ASSERT_TRUE(pool.attach(*busy));
    for (const auto& strand : strands)
        ASSERT_TRUE(pool.attach(*strand));

    pool.schedule(blocker);
    pool.schedule(*busy);
    for (const auto& strand : strands)
        pool.schedule(*strand);
    release.set_value();
    for (const auto& strand : strands)
        WorkerPool::wait_idle(*strand);
    WorkerPool::wait_idle(*busy);
    EXPECT_EQ(turns, static_cast<int>(others));
    EXPECT_LE(busy_turns_at_the_end, 2) << "one turn per round";
}

TEST(WorkerPool, DetectsAWorkerThatHangs) {
    WorkerPool pool(2, 1);
    std::promise<void> release;
    FunctionStrand strand([&] { release.get_future().wait(); });
    ASSERT_TRUE(pool.attach(strand));
    EXPECT_TRUE(pool.responsive(std::chrono::milliseconds(1)));
    pool.schedule(strand);
    while (pool.responsive(std::chrono::milliseconds(1)))
        std::this_thread::yield();
    EXPECT_TRUE(pool.responsive(std::chrono::hours(1)));
    release.set_value();
    WorkerPool::wait_idle(strand);
    while (!pool.responsive(std::chrono::milliseconds(1)))
        std::this_thread::yield();
    pool.detach(strand);
}

// Also workers that hang where no turn of theirs shows it.
TEST(WorkerPool, DetectsATurnThatNobodyBegins) {
    WorkerPool pool(1, 1);
    FunctionStrand waits([] {});
    ASSERT_TRUE(pool.attach(waits));
    EXPECT_TRUE(pool.responsive(std::chrono::nanoseconds(0)));
    pool.stop();
    pool.schedule(waits);
    while (pool.responsive(std::chrono::milliseconds(1)))
        std::this_thread::yield();
    EXPECT_TRUE(pool.responsive(std::chrono::hours(1)));
}

TEST(WorkerPool, EveryItemOfATurnIsDoneOnceByOneWorkerOnALane) {
    constexpr std::size_t strands = 5;
    WorkerPool pool(4, strands);
    std::atomic<int> faults{0};
    std::vector<std::unique_ptr<FunctionStrand>> sharing;
    std::vector<std::size_t> turns(strands);
    for (std::size_t s = 0; s < strands; ++s) {
        sharing.push_back(std::make_unique<FunctionStrand>([&, s](Turn& turn) {
            const std::size_t count = ++turns[s] % 97;
            std::vector<int> done(count);  // not atomic, so that the thread sanitizer reports a race
            std::vector<std::atomic<int>> inside(turn.lanes());
            turn.share(count, 3, [&](std::size_t lane, std::size_t item) {
                faults += inside.at(lane).fetch_add(1);
                ++done.at(item);
                inside[lane].fetch_sub(1);
            });
            faults += static_cast<int>(count) - static_cast<int>(std::count(done.begin(), done.end(), 1));
        }));
        ASSERT_TRUE(pool.attach(*sharing.back()));
    }
    for (std::size_t i = 0; i < 2'000; ++i) {
        for (const auto& strand : sharing)
            pool.schedule(*strand);
        if (i % 10 == 0) WorkerPool::wait_idle(*sharing[i / 10 % strands]);
    }
    for (std::size_t s = 0; s < strands; ++s) {
        WorkerPool::wait_idle(*sharing[s]);
        EXPECT_GT(turns[s], 30U);
        pool.detach(*sharing[s]);
    }
    EXPECT_EQ(faults, 0);
}

TEST(WorkerPool, ATurnSharesNothingAndWithNobody) {
    WorkerPool pool(1, 1);
    int done = 0;
    FunctionStrand strand([&](Turn& turn) {
        turn.share(0, 1, [&](std::size_t /*lane*/, std::size_t /*item*/) { ++done; });
        turn.share(5, 1, [&](std::size_t lane, std::size_t /*item*/) { done += lane == 0 ? 10 : 0; });
    });
    ASSERT_TRUE(pool.attach(strand));
    pool.schedule(strand);
    WorkerPool::wait_idle(strand);
    EXPECT_EQ(done, 50);
    pool.detach(strand);
    pool.stop();
    EXPECT_TRUE(pool.responsive(std::chrono::nanoseconds(0)));
}

TEST(WorkerPool, IdleWorkersHelp) {
    WorkerPool pool(3, 1);
    std::atomic<int> together{0};
    std::atomic<int> missed{0};
    FunctionStrand strand([&](Turn& turn) {
        turn.share(3, 1, [&](std::size_t /*lane*/, std::size_t /*item*/) {
            ++together;
            if (!test::eventually([&] { return together == 3; })) ++missed;
        });
    });
    ASSERT_TRUE(pool.attach(strand));
    pool.schedule(strand);
    WorkerPool::wait_idle(strand);
    EXPECT_EQ(missed, 0) << "not three threads at once";
    pool.detach(strand);
}

TEST(WorkerPool, HoldsNoMoreThanItsCapacity) {
    WorkerPool pool(1, 2);
    FunctionStrand a([] {});
    FunctionStrand b([] {});
    FunctionStrand c([] {});
    EXPECT_TRUE(pool.attach(a));
    EXPECT_TRUE(pool.attach(b));
    EXPECT_FALSE(pool.attach(c));
    pool.detach(a);
    EXPECT_TRUE(pool.attach(c));
    pool.schedule(c);
    WorkerPool::wait_idle(c);
    pool.detach(b);
    pool.detach(c);
}

}  // namespace
}  // namespace camdir::director
