// A pool of threads that runs strands.
#pragma once

#include <semaphore.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <thread>
#include <vector>

namespace camdir::director {

// Something whose work is done by at most one worker at a time.
class Strand {
  public:
    Strand() = default;
    Strand(const Strand&) = delete;
    Strand& operator=(const Strand&) = delete;
    virtual ~Strand() = default;

  private:
    friend class WorkerPool;

    // Handles what has come in by now; may leave some of it when it schedules itself again. What throws is a
    // bug and stops the process.
    virtual void turn() noexcept = 0;

    std::atomic<std::uint32_t> pending_{0};  // schedule() calls that no finished turn has seen
    std::size_t slot_ = 0;
};

// Strands with work are kept as bits that the workers claim in a round: no strand waits for more than one
// turn of each other one, and scheduling takes no lock and no memory.
class WorkerPool {
  public:
    // `capacity`: strands at once.
    WorkerPool(std::size_t workers, std::size_t capacity);
    WorkerPool(const WorkerPool&) = delete;
    WorkerPool& operator=(const WorkerPool&) = delete;
    ~WorkerPool();  // stops; precondition: settled

    // False: as many as `capacity` are attached. Attach and detach: one thread at a time.
    [[nodiscard]] bool attach(Strand& strand);
    // Precondition: settled, and nobody schedules it any more.
    void detach(Strand& strand);

    // The strand gets a turn that begins after this call. Thread-safe.
    void schedule(Strand& strand);

    // The strand has no turn to come.
    [[nodiscard]] static bool settled(const Strand& strand);
    // Waits until that is so.
    static void settle(const Strand& strand);

    // No turn has lasted longer than this. Thread-safe.
    [[nodiscard]] bool responsive(std::chrono::nanoseconds limit) const;

    // Joins the workers; strands scheduled afterwards get no turn.
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
    std::vector<std::atomic<std::uint64_t>> ready_;  // a bit a slot
    std::atomic<std::size_t> next_{0};               // slot at which the round goes on
    sem_t turns_;                                    // one permit a ready bit
    std::atomic<bool> stopping_{false};
    std::vector<std::unique_ptr<Worker>> workers_;
};

}  // namespace camdir::director
