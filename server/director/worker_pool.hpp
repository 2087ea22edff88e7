// A pool of threads that runs strands: pieces of work of which each is run by one thread at a time.
#pragma once

#include <semaphore.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <thread>
#include <vector>

namespace camdir::director {

// Work that at most one worker does at a time.
class Strand {
  public:
    Strand() = default;
    Strand(const Strand&) = delete;
    Strand& operator=(const Strand&) = delete;
    virtual ~Strand() = default;

  private:
    friend class WorkerPool;

    // Processes what is pending. It may leave some of it if it schedules the strand again. An exception is a
    // bug and ends the process.
    virtual void turn() noexcept = 0;

    std::atomic<std::uint32_t> pending_{0};  // schedule() calls not yet covered by a finished turn
    std::size_t slot_ = 0;
};

// Strands with work are bits that the workers claim round robin: a strand waits for at most one turn of every
// other strand. Scheduling takes no lock and allocates nothing.
class WorkerPool {
  public:
    // `capacity` is the largest number of attached strands. Both arguments must be greater than 0.
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

    // True when no current turn has lasted longer than `limit`. Thread-safe.
    [[nodiscard]] bool responsive(std::chrono::nanoseconds limit) const;

    // Joins the workers. Strands scheduled afterwards get no turn.
    void stop();

  private:
    struct alignas(64) Worker {
        std::thread thread;
        std::atomic<std::int64_t> turn_began_ns{0};  // steady clock; 0 = idle
    };

    void work(Worker& worker);
    void run(Worker& worker, Strand& strand);
    Strand* claim();
    Strand* claim_in(std::size_t word, std::uint64_t mask);
    void mark_ready(std::size_t slot);

    std::vector<Strand*> slots_;
    std::vector<std::atomic<std::uint64_t>> ready_;  // one bit per slot
    std::atomic<std::size_t> next_{0};               // slot at which the round continues
    sem_t turns_;                                    // one permit per ready bit
    std::atomic<bool> stopping_{false};
    std::vector<std::unique_ptr<Worker>> workers_;
};

}  // namespace camdir::director
