// Percentiles of durations in constant memory.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace camdir::soak {

// Buckets grow by 1 %, so percentiles are accurate to 1 % from 1 us to 900 s. Values outside count in the
// first or last bucket.
class Latencies {
  public:
    void add(double seconds) {
        ++buckets_[bucket_of(seconds)];
        ++count_;
        largest_ = std::max(largest_, seconds);
    }
    void add(const Latencies& other) {
        for (std::size_t i = 0; i < buckets_.size(); ++i)
            buckets_[i] += other.buckets_[i];
        count_ += other.count_;
        largest_ = std::max(largest_, other.largest_);
    }

    [[nodiscard]] std::uint64_t count() const { return count_; }
    [[nodiscard]] double largest() const { return largest_; }
    // Seconds; share from 0 to 1. 0 when nothing was added.
    [[nodiscard]] double percentile(double share) const {
        const auto wanted = static_cast<std::uint64_t>(std::ceil(share * static_cast<double>(count_)));
        std::uint64_t seen = 0;
        for (std::size_t i = 0; i < buckets_.size(); ++i) {
            seen += buckets_[i];
            if (seen >= wanted && seen > 0) return std::min(largest_, smallest * std::pow(growth, i + 1));
        }
        return 0.0;
    }

  private:
    static constexpr double smallest = 1e-6;
    static constexpr double growth = 1.01;

    static std::size_t bucket_of(double seconds) {
        if (!(seconds > smallest)) return 0;
        const double at = std::log(seconds / smallest) / std::log(growth);
        return std::min(static_cast<std::size_t>(at), bucket_count - 1);
    }

    static constexpr std::size_t bucket_count = 2072;
    std::array<std::uint64_t, bucket_count> buckets_{};
    std::uint64_t count_ = 0;
    double largest_ = 0.0;
};

}  // namespace camdir::soak
