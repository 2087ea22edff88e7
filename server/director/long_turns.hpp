// Matches whose cameras take long to move leave time to others.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "director/worker_pool.hpp"

namespace camdir::director {

// Of one match: whether its turns usually take long for a pose frame, with those that prepare it. Who asks
// for much, such as cameras among hundreds of movers, pays for it alone: it rests for as long as it has
// worked. Whoever is held up, as on a busy machine, is none of them, unless it is so frame after frame.
class LongTurns {
  public:
    // With all help that the turns may have at best: who has it and who has none are judged alike.
    static constexpr std::int64_t long_ns = 20'000'000;        // other matches hardly notice less
    static constexpr std::int64_t very_long_ns = 500'000'000;  // a single one says all
    static constexpr int held_up_limit = 40;  // frames in a row whose turns last long, as where writes wait

    // Part of the work for the next frame is done.
    void prepared(const Turn::Cost& cost) { since_frame_ += cost; }
    // The cameras have moved with a frame. Its processor time is measured if is_suspect() before its parts.
    void moved(const Turn::Cost& cost) {
        const Turn::Cost all = std::exchange(since_frame_, {}) += cost;
        const std::int64_t before = processor_[count_ % processor_.size()];
        const std::size_t last = ++count_ % processor_.size();
        processor_[last] = all.processor;
        helped_[last] = all.helped;
        worked_ = std::min(all.took, std::exchange(last_took_, all.took));  // a stall is no work
        held_up_frames_ = all.helped >= long_ns ? std::min(held_up_frames_ + 1, held_up_limit) : 0;
        // A single long one, as when a group shot begins, says little, two in a row say all.
        is_long_ = std::max(median(processor_), std::min(before, all.processor)) >= long_ns ||
                   all.processor >= very_long_ns || held_up_frames_ == held_up_limit;
    }

    // Whether one of the last lasted long, or none is known: of the next the processor time is to be
    // measured.
    [[nodiscard]] bool is_suspect() const { return *std::ranges::max_element(helped_) >= long_ns; }
    [[nodiscard]] bool is_long() const { return is_long_; }
    // For a frame, of the last two the less, ns; 0 where turns are not long.
    [[nodiscard]] std::int64_t worked() const { return is_long_ ? worked_ : 0; }

  private:
    using Last = std::array<std::int64_t, 5>;

    static std::int64_t median(Last sorted) {
        const auto middle = sorted.begin() + sorted.size() / 2;
        std::nth_element(sorted.begin(), middle, sorted.end());
        return *middle;
    }

    Turn::Cost since_frame_;
    Last helped_{long_ns, long_ns, long_ns, long_ns, long_ns};
    Last processor_{};
    int held_up_frames_ = 0;  // in a row
    std::size_t count_ = 0;
    std::int64_t last_took_ = 0;
    std::int64_t worked_ = 0;
    bool is_long_ = false;
};

}  // namespace camdir::director
