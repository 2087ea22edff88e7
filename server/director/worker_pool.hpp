// A pool of threads that runs strands: pieces of work of which each is run by one thread at a time, with the
// help of idle ones.
#pragma once

#include <semaphore.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "base/turn_timer.hpp"
#include "director/clock.hpp"
#include "director/shared_work.hpp"

namespace camdir::director {

class Turn;

// Work that at most one thread does at a time.
class Strand {
  public:
    Strand() = default;
    Strand(const Strand&) = delete;
    Strand& operator=(const Strand&) = delete;
    virtual ~Strand() = default;

  protected:
    // Of a turn that goes on: those that come may be long, however brief the last ones were.
    void expect_long_turns() { expected_ns_.store(long_turn_ns, std::memory_order_relaxed); }

  private:
    friend class WorkerPool;
    friend class BriefTurns;

    // Processes what is pending. It may leave some of it for another turn that it asks for. An exception is a
    // bug and ends the process.
    virtual void turn(Turn& turn) noexcept = 0;

    // Of the next turn, after one that took so long.
    void expect(std::int64_t last_ns);

    std::atomic<std::uint32_t> pending_{0};  // schedule() calls not yet covered by a finished turn
    static constexpr std::int64_t long_turn_ns = 1'000'000;
    // The longest of its last turns, about; long before the first one.
    std::atomic<std::int64_t> expected_ns_{long_turn_ns};
    std::size_t slot_ = 0;
};

// Strands with work are bits that the workers claim round robin: a strand waits for at most one turn of every
// other strand, and of what other turns share. Scheduling takes no lock and allocates nothing.
class WorkerPool {
  public:
    // `capacity` is the largest number of attached strands. Both arguments must be greater than 0. Throws
    // std::system_error where a thread cannot be started.
    WorkerPool(std::size_t workers, std::size_t capacity);
    WorkerPool(const WorkerPool&) = delete;
    WorkerPool& operator=(const WorkerPool&) = delete;
    ~WorkerPool();  // stops; precondition: all strands are idle

    // Returns false when `capacity` strands are attached. attach() and detach(): one thread at a time.
    [[nodiscard]] bool attach(Strand& strand);
    // Precondition: the strand is idle and is not scheduled again.
    void detach(Strand& strand);

    // Gives the strand a turn that begins after this call. Thread-safe.
    void schedule(Strand& strand);

    // True when the strand is in no turn and none is due.
    [[nodiscard]] static bool idle(const Strand& strand);
    // Waits until the strand is idle.
    static void wait_idle(const Strand& strand);

    // True when no thread has been busy for longer than `limit` with one turn, or one item of a turn that it
    // shares, and no turn that is due has waited so long while none of them went on. Thread-safe.
    [[nodiscard]] bool responsive(std::chrono::nanoseconds limit) const;

    [[nodiscard]] std::size_t workers() const { return workers_.size(); }
    // That all threads have spent on turns and on helping, together, without those that go on. Thread-safe.
    [[nodiscard]] std::chrono::nanoseconds busy() const;

    // Joins the workers. Strands scheduled afterwards get no turn of a worker.
    void stop();

  private:
    friend class Turn;
    friend class BriefTurns;

    struct alignas(64) Worker {
        std::thread thread;    // none: whoever calls
        std::size_t lane = 0;  // when it helps others: from 1
        TurnTimer turn;        // or helping
        SharedWork shared;     // of its turn
    };

    void start();
    void work(Worker& worker);
    bool claim_call();
    void help(Worker& worker);
    void call_helpers(std::size_t count);
    void run(Worker& worker, Strand& strand);
    Strand* claim();
    Strand* claim_in(std::size_t word, std::uint64_t mask);
    void mark_ready(std::size_t slot);
    [[nodiscard]] bool waits_since(std::int64_t ns) const;

    std::vector<Strand*> slots_;
    std::vector<std::atomic<std::uint64_t>> ready_;          // one bit per slot
    std::vector<std::atomic<std::int64_t>> ready_since_ns_;  // per slot, of its last ready bit; steady clock
    std::atomic<std::int64_t> went_on_ns_{0};  // when a worker claimed a strand or did an item last
    std::atomic<std::size_t> next_{0};         // slot at which the round continues
    std::atomic<std::size_t> calls_{0};        // for help, not yet answered by a worker
    std::atomic<std::size_t> long_turns_{0};   // that go on
    sem_t work_available_;                     // one permit per ready bit and per call
    std::atomic<bool> stopping_{false};
    std::vector<std::unique_ptr<Worker>> workers_;
    std::mutex calling_;  // guards the next two
    Worker caller_;
    std::vector<Strand*> brief_;
};

// Turns that the calling thread runs itself where they are brief: waking a worker for one would cost more.
// What is long, or more than the caller has time for, is the workers'. Of several threads that schedule at
// the same time one runs turns, and the workers run those of the others.
class BriefTurns {
  public:
    explicit BriefTurns(WorkerPool& pool) : pool_(pool), lock_(pool.calling_, std::try_to_lock) {}
    BriefTurns(const BriefTurns&) = delete;
    BriefTurns& operator=(const BriefTurns&) = delete;
    // Runs them. The thread must have locked nothing that a turn may wait for.
    ~BriefTurns();

    // Gives the strand a turn that begins after this call: on a worker, or in the destructor.
    void schedule(Strand& strand);

  private:
    WorkerPool& pool_;
    std::unique_lock<std::mutex> lock_;
    std::int64_t left_ns_ = 150'000;  // of the caller's time
};

// What a strand may ask of the pool during its turn.
class Turn {
  public:
    // In ns, of a turn or a part of one.
    struct Cost {
        std::int64_t took = 0;
        std::int64_t helped = 0;     // that it would have taken if all whom share() may call had helped
        std::int64_t processor = 0;  // the same, in processor time: without what waited; 0 where not measured

        Cost& operator+=(const Cost& other) {
            took += other.took;
            helped += other.helped;
            processor += other.processor;
            return *this;
        }
    };

    // From here on its processor time is measured too, which costs two calls of the kernel for every item.
    void measure_processor() { processor_begun_ns_ = processor_ns(); }
    // Until now.
    [[nodiscard]] Cost cost() const;

    // Does `item` for every number below `count`, with the help of idle workers, of which each should find
    // `share` > 0 items to do. Every lane is less than lanes().
    void share(std::size_t count, std::size_t share, const SharedWork::Item& item);

    // For a turn that will take long, before it shares anything: nobody helps in it, and at most half of the
    // workers, one at the least, are in such turns. False: it is none, because too many go on.
    [[nodiscard]] bool begin_long();

    [[nodiscard]] std::size_t lanes() const { return workers() + 1; }
    [[nodiscard]] std::size_t workers() const { return pool_.workers(); }

    // Gives the strand another turn, after those of the strands that are due now.
    void again() { pool_.schedule(strand_); }

  private:
    friend class WorkerPool;
    Turn(WorkerPool& pool, WorkerPool::Worker& worker, Strand& strand)
        : pool_(pool), worker_(worker), strand_(strand) {}

    [[nodiscard]] std::int64_t processor_now() const { return processor_begun_ns_ ? processor_ns() : 0; }

    WorkerPool& pool_;
    WorkerPool::Worker& worker_;
    Strand& strand_;
    const std::int64_t begun_ns_ = now_ns();
    std::optional<std::int64_t> processor_begun_ns_;  // where it is measured
    bool is_long_ = false;
    Cost saved_;  // by the helpers that share() would have had
};

}  // namespace camdir::director
