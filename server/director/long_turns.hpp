// Matches whose cameras take long to move leave time to others.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace camdir::director {

// Of one match: whether its turns usually take long for a pose frame, with those that prepare it. Who asks
// for much, such as cameras among hundreds of movers, pays for it alone: it rests for as long as it has
// worked.
class LongTurns {
  public:
    static constexpr std::int64_t long_ns = 20'000'000;          // other matches hardly notice shorter ones
    static constexpr std::int64_t very_long_ns = 2'000'000'000;  // a stall is shorter

    // ns. What decides is `helped`: who has help and who has none must not be judged by different measures.
    struct Cost {
        std::int64_t took = 0;
        std::int64_t helped = 0;  // that it would have taken with all help that it may have at best

        Cost& operator+=(const Cost& other) {
            took += other.took;
            helped += other.helped;
            return *this;
        }
    };

    // Part of the work for the next frame is done.
    void prepared(const Cost& cost) { since_frame_ += cost; }
    // The cameras have moved with a frame.
    void moved(const Cost& cost) {
        const Cost all = std::exchange(since_frame_, {}) += cost;
        const std::int64_t before = last_[count_ % last_.size()];
        std::int64_t& last = last_[++count_ % last_.size()];
        last = all.helped;
        worked_ = std::min(all.took, std::exchange(last_took_, all.took));  // a stall is no work
        // A single long one, as when a group shot begins or the machine stalls, says little, two in a row say
        // all.
        is_long_ = std::max(median(last_), std::min(before, last)) >= long_ns || last >= very_long_ns;
    }

    [[nodiscard]] bool is_long() const { return is_long_; }
    // Whether one of the last took long: what the next cost is to be said in processor time. Whoever was only
    // held up, by a busy machine or a write that waits, does not become long.
    [[nodiscard]] bool is_suspect() const { return *std::ranges::max_element(last_) >= long_ns; }
    // For a frame, of the last two the less, ns; 0 where turns are not long.
    [[nodiscard]] std::int64_t worked() const { return is_long_ ? worked_ : 0; }

  private:
    using Last = std::array<std::int64_t, 5>;

    static std::int64_t median(Last sorted) {
        const auto middle = sorted.begin() + sorted.size() / 2;
        std::nth_element(sorted.begin(), middle, sorted.end());
        return *middle;
    }

    Cost since_frame_;
    Last last_{};
    std::size_t count_ = 0;
    std::int64_t last_took_ = 0;
    std::int64_t worked_ = 0;
    bool is_long_ = false;
};

}  // namespace camdir::director
