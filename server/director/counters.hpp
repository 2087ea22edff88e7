// A match's counters: any thread may add and read.
#pragma once

#include <atomic>

#include "director/view.hpp"

namespace camdir::director {

class DurationCounter {
  public:
    void add(std::int64_t ns) {
        std::size_t bucket = 0;
        while (bucket < bounds_ns.size() && ns > bounds_ns[bucket])
            ++bucket;
        buckets_[bucket].fetch_add(1, std::memory_order_relaxed);
        sum_ns_.fetch_add(ns, std::memory_order_relaxed);
    }

    void add_to(Durations& sum) const {
        for (std::size_t i = 0; i < buckets_.size(); ++i)
            sum.buckets[i] += buckets_[i].load(std::memory_order_relaxed);
        sum.sum_s += static_cast<double>(sum_ns_.load(std::memory_order_relaxed)) * 1e-9;
    }

  private:
    static constexpr auto bounds_ns = [] {
        std::array<std::int64_t, Durations::bounds_s.size()> ns{};
        for (std::size_t i = 0; i < ns.size(); ++i)
            ns[i] = static_cast<std::int64_t>(Durations::bounds_s[i] * 1e9 + 0.5);
        return ns;
    }();

    std::array<std::atomic<std::uint64_t>, bounds_ns.size() + 1> buckets_{};
    std::atomic<std::int64_t> sum_ns_{0};
};

// What one match contributes to Statistics.
class MatchCounters {
  public:
    void add(Counter counter, std::uint64_t count = 1) {
        counts_[static_cast<std::size_t>(counter)].fetch_add(count, std::memory_order_relaxed);
    }

    void add_to(Statistics& sum) const {
        for (std::size_t i = 0; i < counts_.size(); ++i)
            sum.counters[i] += counts_[i].load(std::memory_order_relaxed);
        step.add_to(sum.step);
        latency.add_to(sum.latency);
        waiting.add_to(sum.waiting);
        computing.add_to(sum.computing);
        writing.add_to(sum.writing);
    }

    DurationCounter step;
    DurationCounter latency;
    DurationCounter waiting, computing, writing;  // its parts

  private:
    std::array<std::atomic<std::uint64_t>, counter_count> counts_{};
};

}  // namespace camdir::director
