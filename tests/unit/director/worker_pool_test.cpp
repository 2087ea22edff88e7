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
#include "work_for.hpp"

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

TEST(WorkerPool, OneThreadAtATimeRunsAStrand) {
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
    for (int t = 0; t < 2; ++t)
        threads.emplace_back([&] {
            for (int i = 0; i < 300; ++i)
                for (Counted& one : counted)
                    pool.schedule(*one.strand);
        });
    for (int t = 0; t < 2; ++t)
        threads.emplace_back([&] {
            for (int i = 0; i < 300; ++i) {
                BriefTurns turns(pool);
                for (Counted& one : counted)
                    turns.schedule(*one.strand);
            }
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

// However long a turn of many shots takes: whoever goes on does not hang, and whoever does not does.
TEST(WorkerPool, ALongTurnThatGoesOnDoesNotHang) {
    constexpr std::size_t items = 50;
    constexpr std::chrono::milliseconds limit(50);
    WorkerPool pool(1, 2);
    std::atomic<std::size_t> allowed{0};
    FunctionStrand strand([&](Turn& turn) {
        std::size_t done = 0;
        turn.share(items, items, [&](std::size_t, std::size_t) {
            while (allowed.load() == done)
                std::this_thread::yield();
            ++done;
        });
    });
    FunctionStrand other([] {});
    ASSERT_TRUE(pool.attach(strand) && pool.attach(other));
    pool.schedule(strand);
    pool.schedule(other);  // which waits meanwhile
    int went_on = 0;
    for (std::size_t item = 0; item + 1 < items; ++item) {
        ASSERT_TRUE(test::eventually([&] { return !pool.responsive(limit); }));
        ++allowed;  // this one ends, the next one begins
        const auto since = std::chrono::steady_clock::now();
        bool responsive = false;
        while (!responsive && std::chrono::steady_clock::now() - since < limit)
            responsive = pool.responsive(limit);
        went_on += responsive ? 1 : 0;
    }
    EXPECT_GT(went_on, 0);
    ++allowed;
    WorkerPool::wait_idle(strand);
    WorkerPool::wait_idle(other);
    pool.detach(strand);
    pool.detach(other);
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

// What a turn costs that shares eight items among four.
Turn::Cost cost_of(bool is_long, const std::function<void()>& item) {
    WorkerPool pool(4, 1);
    Turn::Cost cost;
    FunctionStrand strand([&](Turn& turn) {
        turn.measure_processor();
        EXPECT_TRUE(!is_long || turn.begin_long());
        turn.share(8, 2, [&](std::size_t /*lane*/, std::size_t /*item*/) { item(); });
        cost = turn.cost();
    });
    EXPECT_TRUE(pool.attach(strand));
    pool.schedule(strand);
    WorkerPool::wait_idle(strand);
    pool.detach(strand);
    return cost;
}

TEST(WorkerPool, TheCostOfATurnIsToldAsIfAllHadHelped) {
    const std::int64_t item_ns = 10'000'000;
    const auto works = [item_ns] { work_for(std::chrono::nanoseconds(item_ns)); };
    const auto waits = [item_ns] { std::this_thread::sleep_for(std::chrono::nanoseconds(item_ns)); };
    for (const bool is_long : {false, true}) {
        const Turn::Cost worked = cost_of(is_long, works);
        EXPECT_GE(worked.processor, 2 * item_ns);
        EXPECT_LT(worked.processor, 3 * item_ns);
        EXPECT_GE(worked.helped, 2 * item_ns - item_ns / 100) << "clocks differ";
        const Turn::Cost waited = cost_of(is_long, waits);
        EXPECT_GE(waited.helped, 2 * item_ns);
        EXPECT_GE(waited.processor, 0);
        EXPECT_LT(waited.processor, item_ns);
        if (!is_long) continue;
        EXPECT_GE(worked.took - worked.helped, 5 * item_ns) << "nobody has";
        EXPECT_GE(waited.took - waited.helped, 5 * item_ns);
    }
}

TEST(WorkerPool, LongTurnsLeaveHalfOfTheWorkersToOthers) {
    WorkerPool pool(4, 4);
    std::atomic<int> begun{0};
    std::atomic<int> refused{0};
    std::vector<std::unique_ptr<FunctionStrand>> strands;
    for (int i = 0; i < 4; ++i) {
        strands.push_back(std::make_unique<FunctionStrand>([&](Turn& turn) {
            ++(turn.begin_long() ? begun : refused);
            EXPECT_TRUE(test::eventually([&] { return begun + refused == 4; }));
        }));
        ASSERT_TRUE(pool.attach(*strands.back()));
    }
    for (const auto& strand : strands)
        pool.schedule(*strand);
    for (const auto& strand : strands)
        WorkerPool::wait_idle(*strand);
    EXPECT_EQ(begun, 2);
    EXPECT_EQ(refused, 2);
    for (const auto& strand : strands)
        pool.detach(*strand);
    FunctionStrand later([&](Turn& turn) {
        if (turn.begin_long()) ++begun;
    });
    ASSERT_TRUE(pool.attach(later));
    for (int i = 0; i < 5; ++i) {
        pool.schedule(later);
        WorkerPool::wait_idle(later);
    }
    EXPECT_EQ(begun, 7) << "those before are over";
    pool.detach(later);
}

TEST(WorkerPool, NobodyHelpsInALongTurn) {
    WorkerPool pool(4, 1);
    std::atomic<int> elsewhere{0};
    int done = 0;  // not atomic, so that the thread sanitizer reports a race
    FunctionStrand strand([&](Turn& turn) {
        ASSERT_TRUE(turn.begin_long());
        const auto thread = std::this_thread::get_id();
        turn.share(1000, 1, [&](std::size_t lane, std::size_t /*item*/) {
            ++done;
            if (lane != 0 || std::this_thread::get_id() != thread) ++elsewhere;
        });
    });
    ASSERT_TRUE(pool.attach(strand));
    pool.schedule(strand);
    WorkerPool::wait_idle(strand);
    EXPECT_EQ(done, 1000);
    EXPECT_EQ(elsewhere, 0);
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

// Strands that count on which threads they have turns.
class BriefTurnsTest : public testing::Test {
  protected:
    struct Turns {
        std::atomic<int> here{0}, elsewhere{0};
    };

    std::unique_ptr<FunctionStrand> strand(
        Turns& turns, std::function<void()> work = [] {}) {
        auto strand = std::make_unique<FunctionStrand>([&turns, here = here_, work] {
            work();
            ++(std::this_thread::get_id() == here ? turns.here : turns.elsewhere);
        });
        EXPECT_TRUE(pool_.attach(*strand));
        return strand;
    }
    void schedule(std::initializer_list<FunctionStrand*> strands) {
        BriefTurns turns(pool_);
        for (FunctionStrand* one : strands)
            turns.schedule(*one);
    }
    // Schedules these until the calling thread runs the turn that is counted: what is expected of it is the
    // longest of its last turns, and a busy machine may make any of them long.
    void schedule_until_here(std::initializer_list<FunctionStrand*> strands, const Turns& turns) {
        const int before = turns.here;
        ASSERT_TRUE(test::eventually([&] {
            schedule(strands);
            return turns.here > before;
        }));
    }

    const std::thread::id here_ = std::this_thread::get_id();
    WorkerPool pool_{2, 8};
};

TEST_F(BriefTurnsTest, AreRunOnTheCallingThreadOnceKnown) {
    Turns turns;
    const auto brief = strand(turns);
    schedule({brief.get()});
    WorkerPool::wait_idle(*brief);
    EXPECT_EQ(turns.elsewhere, 1) << "nothing is known of it yet";
    ASSERT_TRUE(test::eventually([&] {
        WorkerPool::wait_idle(*brief);
        const int elsewhere = turns.elsewhere;
        turns.here = 0;
        schedule({brief.get(), brief.get()});
        if (turns.here == 0 || turns.elsewhere > elsewhere) return false;  // a worker had the first
        EXPECT_TRUE(WorkerPool::idle(*brief));
        return true;
    }));
    EXPECT_EQ(turns.here, 1) << "one turn covers what was scheduled before it";
}

TEST_F(BriefTurnsTest, LongOnesAreTheWorkers) {
    Turns turns;
    const auto slow = strand(turns, [] { std::this_thread::sleep_for(std::chrono::milliseconds(5)); });
    for (int i = 0; i < 20; ++i) {
        schedule({slow.get()});
        WorkerPool::wait_idle(*slow);
    }
    EXPECT_EQ(turns.here, 0);
    EXPECT_EQ(turns.elsewhere, 20);
}

TEST_F(BriefTurnsTest, WhatIsLongNowAndThenIsTheWorkers) {
    Turns turns;
    int turn = 0;
    const auto slow = strand(turns, [&] {
        if (++turn % 4 == 0) std::this_thread::sleep_for(std::chrono::microseconds(300));
    });
    for (int i = 0; i < 100; ++i) {
        schedule({slow.get()});
        WorkerPool::wait_idle(*slow);
    }
    EXPECT_EQ(turns.here, 0);
}

TEST_F(BriefTurnsTest, WhatMayBeLongIsTheWorkers) {
    class WarningStrand final : public Strand {
      public:
        std::atomic<int> turns{0}, here{0};

      private:
        void turn(Turn& /*turn*/) noexcept override {
            ++turns;
            if (std::this_thread::get_id() == caller_) ++here;
            expect_long_turns();
        }
        const std::thread::id caller_ = std::this_thread::get_id();
    } strand;
    ASSERT_TRUE(pool_.attach(strand));
    for (int i = 0; i < 100; ++i) {
        BriefTurns(pool_).schedule(strand);
        WorkerPool::wait_idle(strand);
    }
    EXPECT_EQ(strand.turns, 100);
    EXPECT_EQ(strand.here, 0);
}

TEST_F(BriefTurnsTest, DoNotWaitForLongOnes) {
    Turns turns, slow_turns;
    std::promise<void> release;
    const std::shared_future<void> released = release.get_future().share();
    const auto slow = strand(slow_turns, [released] { released.wait(); });
    const auto brief = strand(turns);
    schedule_until_here({slow.get(), brief.get()}, turns);
    EXPECT_FALSE(WorkerPool::idle(*slow));
    EXPECT_EQ(slow_turns.here, 0);
    release.set_value();
    WorkerPool::wait_idle(*slow);
    EXPECT_GE(slow_turns.elsewhere, 1);
}

TEST_F(BriefTurnsTest, WhatTheCallerHasNoTimeForIsTheWorkers) {
    constexpr std::size_t count = 40;
    WorkerPool pool(2, count);
    std::atomic<int> faults{0};
    std::vector<std::atomic<int>> here(count), turns(count);
    std::vector<std::unique_ptr<FunctionStrand>> strands;
    for (std::size_t i = 0; i < count; ++i) {
        strands.push_back(std::make_unique<FunctionStrand>([&, i] {
            const auto end = std::chrono::steady_clock::now() + std::chrono::microseconds(100);
            while (std::chrono::steady_clock::now() < end) {
            }
            ++turns[i];
            if (std::this_thread::get_id() == here_) ++here[i];
        }));
        ASSERT_TRUE(pool.attach(*strands[i]));
    }
    int most = 0;
    for (int round = 1; round <= 50; ++round) {
        {
            BriefTurns brief(pool);
            for (const auto& one : strands)
                brief.schedule(*one);
        }
        int together = 0;
        for (std::size_t i = 0; i < count; ++i) {
            WorkerPool::wait_idle(*strands[i]);
            faults += turns[i] == round ? 0 : 1;
            together += here[i].exchange(0);
        }
        most = std::max(most, together);
    }
    EXPECT_EQ(faults, 0) << "each has one turn each time";
    EXPECT_LE(most, 1) << "0.15 ms of the caller's time";
}

TEST_F(BriefTurnsTest, AreCoveredByATurnThatGoesOnElsewhere) {
    Turns turns;
    std::atomic<bool> goes_on{false};
    std::atomic<bool> holds{false};
    const auto one = strand(turns, [&] {
        goes_on = true;
        while (holds)
            std::this_thread::yield();
    });
    schedule_until_here({one.get()}, turns);
    WorkerPool::wait_idle(*one);
    const int here = turns.here;
    const int elsewhere = turns.elsewhere;
    goes_on = false;
    holds = true;
    pool_.schedule(*one);
    while (!goes_on)
        std::this_thread::yield();
    schedule({one.get()});
    holds = false;
    WorkerPool::wait_idle(*one);
    EXPECT_EQ(turns.here, here);
    EXPECT_EQ(turns.elsewhere, elsewhere + 2) << "its next turn begins after the call";
}

TEST_F(BriefTurnsTest, AreDetectedWhereTheyHang) {
    Turns turns;
    std::atomic<bool> hangs{false};
    const auto one = strand(turns, [&] {
        while (hangs)
            std::this_thread::yield();
    });
    const auto hang = [&] {
        hangs = true;
        std::thread watch([&] {
            while (pool_.responsive(std::chrono::milliseconds(1)))
                std::this_thread::yield();
            EXPECT_TRUE(pool_.responsive(std::chrono::hours(1)));
            hangs = false;
        });
        schedule({one.get()});
        watch.join();
        WorkerPool::wait_idle(*one);
    };
    schedule_until_here({one.get()}, turns);
    ASSERT_TRUE(test::eventually([&] {
        WorkerPool::wait_idle(*one);
        const int before = turns.here;
        hang();
        if (turns.here > before) return true;
        schedule_until_here({one.get()}, turns);  // it has become long for what is known
        return false;
    }));
    EXPECT_TRUE(test::eventually([&] { return pool_.responsive(std::chrono::milliseconds(100)); }));
}

TEST_F(BriefTurnsTest, HaveTheHelpOfIdleWorkers) {
    WorkerPool pool(2, 1);
    std::atomic<int> together{0};
    std::atomic<int> missed{0};
    std::atomic<bool> shares{false};
    std::atomic<int> here{0};
    FunctionStrand one([&](Turn& turn) {
        if (std::this_thread::get_id() != here_) return;
        ++here;
        if (!shares) return;
        turn.share(2, 1, [&](std::size_t /*lane*/, std::size_t /*item*/) {
            ++together;
            if (!test::eventually([&] { return together == 2; })) ++missed;
        });
    });
    ASSERT_TRUE(pool.attach(one));
    const auto schedule = [&] {
        BriefTurns turns(pool);
        turns.schedule(one);
    };
    ASSERT_TRUE(test::eventually([&] {
        schedule();
        WorkerPool::wait_idle(one);
        return here > 0;
    }));
    shares = true;
    ASSERT_TRUE(test::eventually([&] {
        schedule();
        WorkerPool::wait_idle(one);
        return together > 0;
    }));
    EXPECT_EQ(together, 2);
    EXPECT_EQ(missed, 0);
}

}  // namespace
}  // namespace camdir::director
