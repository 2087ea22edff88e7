// Timings of single queries.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <vector>

namespace camdir::bench {

// Nanoseconds of single queries, less what the clock takes.
class Samples {
  public:
    template <class Query>
    auto time(const Query& query) {
        const auto begin = Clock::now();
        auto answer = query();
        const auto end = Clock::now();
        nanoseconds_.push_back(std::max(nanoseconds_of(end - begin) - clock_cost(), 0.0));
        return answer;
    }

    void add(const Samples& other) {
        nanoseconds_.insert(nanoseconds_.end(), other.nanoseconds_.begin(), other.nanoseconds_.end());
    }

    [[nodiscard]] const std::vector<double>& nanoseconds() const { return nanoseconds_; }
    [[nodiscard]] std::size_t count() const { return nanoseconds_.size(); }
    // 0 without samples.
    [[nodiscard]] double quantile(double share) const {
        if (nanoseconds_.empty()) return 0.0;
        std::vector<double> sorted = nanoseconds_;
        const auto nth = static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1));
        std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(nth), sorted.end());
        return sorted[nth];
    }

  private:
    using Clock = std::chrono::steady_clock;

    static double nanoseconds_of(Clock::duration duration) {
        return std::chrono::duration<double, std::nano>(duration).count();
    }
    static double clock_cost() {
        static const double cost = [] {
            std::vector<double> gaps(1001);
            for (double& gap : gaps) {
                const auto begin = Clock::now();
                gap = nanoseconds_of(Clock::now() - begin);
            }
            std::sort(gaps.begin(), gaps.end());
            return gaps[gaps.size() / 2];
        }();
        return cost;
    }

    std::vector<double> nanoseconds_;
};

}  // namespace camdir::bench
