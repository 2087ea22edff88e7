#include "director/worker_pool.hpp"

#include <pthread.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <cerrno>
#include <string>

#include "director/clock.hpp"

namespace camdir::director {
namespace {

constexpr std::size_t word_bits = 64;
constexpr std::int64_t remembered_turns = 8;

}  // namespace

// A POSIX semaphore: libstdc++ 12's std::counting_semaphore can miss a wake-up.
WorkerPool::WorkerPool(std::size_t workers, std::size_t capacity)
    : slots_(capacity, nullptr), ready_((capacity + word_bits - 1) / word_bits), ready_since_ns_(capacity) {
    assert(workers > 0 && capacity > 0);
    [[maybe_unused]] const int failed = ::sem_init(&work_available_, 0, 0);
    assert(failed == 0);
    for (std::size_t i = 0; i < workers; ++i)
        workers_.emplace_back(std::make_unique<Worker>())->lane = i + 1;
    try {
        start();
    } catch (...) {
        stop();
        ::sem_destroy(&work_available_);
        throw;
    }
}

// When all workers are there: they help each other.
void WorkerPool::start() {
    for (const auto& worker : workers_) {
        worker->thread = std::thread([this, &worker] { work(*worker); });
        const std::string name = "worker-" + std::to_string(worker->lane - 1);
        ::pthread_setname_np(worker->thread.native_handle(), name.c_str());
    }
}

WorkerPool::~WorkerPool() {
    stop();
    ::sem_destroy(&work_available_);
}

void WorkerPool::stop() {
    if (stopping_.exchange(true)) return;
    for (std::size_t i = 0; i < workers_.size(); ++i)
        ::sem_post(&work_available_);
    for (const auto& worker : workers_)
        if (worker->thread.joinable()) worker->thread.join();
}

bool WorkerPool::attach(Strand& strand) {
    const auto free = std::find(slots_.begin(), slots_.end(), nullptr);
    if (free == slots_.end()) return false;
    *free = &strand;
    strand.slot_ = static_cast<std::size_t>(free - slots_.begin());
    return true;
}

void WorkerPool::detach(Strand& strand) {
    assert(idle(strand));
    slots_[strand.slot_] = nullptr;
}

bool WorkerPool::idle(const Strand& strand) {
    return strand.pending_.load(std::memory_order_acquire) == 0;
}

void WorkerPool::wait_idle(const Strand& strand) {
    while (!idle(strand))
        std::this_thread::sleep_for(std::chrono::microseconds(100));
}

void WorkerPool::schedule(Strand& strand) {
    if (strand.pending_.fetch_add(1, std::memory_order_acq_rel) == 0) mark_ready(strand.slot_);
}

// Rises at once and falls slowly: where every twelfth turn is long, the caller runs none of them.
void Strand::expect(std::int64_t last_ns) {
    const std::int64_t expected = expected_ns_.load(std::memory_order_relaxed);
    expected_ns_.store(std::max(last_ns, expected + (last_ns - expected) / remembered_turns),
                       std::memory_order_relaxed);
}

void WorkerPool::mark_ready(std::size_t slot) {
    ready_since_ns_[slot].store(now_ns(),
                                std::memory_order_relaxed);  // before the bit: whoever sees it, sees this
    ready_[slot / word_bits].fetch_or(std::uint64_t{1} << slot % word_bits);
    ::sem_post(&work_available_);
}

void WorkerPool::work(Worker& worker) {
    for (;;) {
        while (::sem_wait(&work_available_) != 0)
            assert(errno == EINTR);
        worker.turn.begin();
        if (claim_call()) {  // before strands: it shortens a turn that goes on
            help(worker);
        } else {
            Strand* strand = claim();
            if (strand == nullptr) break;
            went_on_ns_.store(now_ns(), std::memory_order_relaxed);
            run(worker, *strand);
        }
        worker.turn.end();
    }
    worker.turn.end();  // stopped
}

std::chrono::nanoseconds WorkerPool::busy() const {
    std::chrono::nanoseconds sum(0);
    for (const auto& worker : workers_)
        sum += worker->turn.busy();
    return sum + caller_.turn.busy();
}

bool WorkerPool::claim_call() {
    std::size_t calls = calls_.load(std::memory_order_acquire);
    while (calls != 0)
        if (calls_.compare_exchange_weak(calls, calls - 1, std::memory_order_acq_rel)) return true;
    return false;
}

void WorkerPool::help(Worker& worker) {
    for (const auto& other : workers_)
        other->shared.help(worker.lane);
    caller_.shared.help(worker.lane);
}

void WorkerPool::call_helpers(std::size_t count) {
    calls_.fetch_add(count, std::memory_order_release);
    for (std::size_t i = 0; i < count; ++i)
        ::sem_post(&work_available_);
}

void Turn::share(std::size_t count, std::size_t share, const SharedWork::Item& item) {
    const std::int64_t begun = now_ns();
    const std::int64_t processor_begun = processor_now();
    std::atomic<std::int64_t> work{0};
    std::atomic<std::int64_t> processor_work{0};
    const SharedWork::Item timed = [&](std::size_t lane, std::size_t i) {
        const std::int64_t item_begun = now_ns();
        const std::int64_t item_processor_begun = processor_now();
        item(lane, i);
        if (processor_begun_ns_)
            processor_work.fetch_add(processor_ns() - item_processor_begun, std::memory_order_relaxed);
        const std::int64_t item_ended = now_ns();
        work.fetch_add(item_ended - item_begun, std::memory_order_relaxed);
        (lane == 0 ? worker_ : *pool_.workers_[lane - 1]).turn.go_on();
        pool_.went_on_ns_.store(item_ended, std::memory_order_relaxed);
    };
    const std::size_t worth = std::min((count + share - 1) / share, workers());
    if (is_long_) {
        for (std::size_t i = 0; i < count; ++i)
            timed(0, i);
    } else {
        worker_.shared.begin(count, timed);
        if (worth > 1) pool_.call_helpers(worth - 1);
        worker_.shared.finish();
    }
    const auto helpers = std::max<std::int64_t>(static_cast<std::int64_t>(worth), 1);
    saved_ += {.helped = now_ns() - begun - work / helpers,
               .processor = processor_now() - processor_begun - processor_work / helpers};
}

Turn::Cost Turn::cost() const {
    const std::int64_t took = now_ns() - begun_ns_;
    const std::int64_t processor = processor_begun_ns_ ? processor_ns() - *processor_begun_ns_ : 0;
    return {.took = took, .helped = took - saved_.helped, .processor = processor - saved_.processor};
}

bool Turn::begin_long() {
    const std::size_t most = std::max<std::size_t>(workers() / 2, 1);
    std::size_t running = pool_.long_turns_.load();
    while (running < most && !is_long_)
        is_long_ = pool_.long_turns_.compare_exchange_weak(running, running + 1);
    return is_long_;
}

void WorkerPool::run(Worker& worker, Strand& strand) {
    const std::size_t slot = strand.slot_;
    const std::uint32_t seen = strand.pending_.load(std::memory_order_acquire);
    Turn turn(*this, worker, strand);
    strand.turn(turn);
    if (turn.is_long_) long_turns_.fetch_sub(1);
    strand.expect(now_ns() - turn.begun_ns_);
    // As soon as nothing is pending the strand may be destroyed.
    if (strand.pending_.fetch_sub(seen, std::memory_order_acq_rel) != seen) mark_ready(slot);
}

// Claims the first ready strand from next_ on, wrapping around; null when stopping.
Strand* WorkerPool::claim() {
    for (;;) {
        const std::size_t from = next_.load(std::memory_order_relaxed);
        const std::size_t first = from / word_bits;
        const std::uint64_t above = ~std::uint64_t{0} << from % word_bits;
        if (Strand* strand = claim_in(first, above)) return strand;
        for (std::size_t i = 1; i < ready_.size(); ++i)
            if (Strand* strand = claim_in((first + i) % ready_.size(), ~std::uint64_t{0})) return strand;
        if (Strand* strand = claim_in(first, ~above)) return strand;
        if (stopping_.load()) return nullptr;
    }
}

Strand* WorkerPool::claim_in(std::size_t word, std::uint64_t mask) {
    std::uint64_t ready = ready_[word].load(std::memory_order_acquire);
    while ((ready & mask) != 0) {
        const auto bit = static_cast<std::size_t>(std::countr_zero(ready & mask));
        const std::uint64_t claimed = std::uint64_t{1} << bit;
        ready = ready_[word].fetch_and(~claimed, std::memory_order_acq_rel);
        if ((ready & claimed) == 0) continue;  // another worker claimed it
        const std::size_t slot = word * word_bits + bit;
        next_.store((slot + 1) % slots_.size(), std::memory_order_relaxed);
        return slots_[slot];
    }
    return nullptr;
}

bool WorkerPool::responsive(std::chrono::nanoseconds limit) const {
    const std::int64_t latest = now_ns() - limit.count();
    const bool starves = went_on_ns_.load(std::memory_order_relaxed) < latest && waits_since(latest);
    return !starves && caller_.turn.within(limit) &&
           std::ranges::all_of(workers_, [&](const auto& worker) { return worker->turn.within(limit); });
}

bool WorkerPool::waits_since(std::int64_t ns) const {
    for (std::size_t slot = 0; slot < slots_.size(); ++slot) {
        const std::uint64_t bit = std::uint64_t{1} << slot % word_bits;
        if ((ready_[slot / word_bits].load() & bit) != 0 &&
            ready_since_ns_[slot].load(std::memory_order_relaxed) < ns)
            return true;
    }
    return false;
}

void BriefTurns::schedule(Strand& strand) {
    if (strand.pending_.fetch_add(1, std::memory_order_acq_rel) != 0) return;
    const std::int64_t expected_ns = strand.expected_ns_.load(std::memory_order_relaxed);
    if (!lock_ || expected_ns > left_ns_) return pool_.mark_ready(strand.slot_);
    left_ns_ -= expected_ns;
    pool_.brief_.push_back(&strand);
}

BriefTurns::~BriefTurns() {
    if (!lock_) return;
    for (Strand* strand : pool_.brief_) {
        pool_.caller_.turn.begin();
        pool_.run(pool_.caller_, *strand);
        pool_.caller_.turn.end();
    }
    pool_.brief_.clear();
}

}  // namespace camdir::director
