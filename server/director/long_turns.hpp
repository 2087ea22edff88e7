// Matches whose cameras take long to move leave time to others.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace camdir::director {

// Of one match: how long its turns usually take for a pose frame, all together. Who asks for much, such as
// cameras among hundreds of movers, pays for it alone: such a match rests for as long as it has worked.
class LongTurns {
  public:
    static constexpr std::int64_t long_ns = 20'000'000;  // other matches hardly notice shorter ones

    // A turn has taken so long. `of_frame`: it moved the cameras.
    void add(std::int64_t ns, bool of_frame) {
        since_frame_ += ns;
        if (!of_frame) return;
        const std::int64_t before = last_[count_ % last_.size()];
        std::int64_t& last = last_[++count_ % last_.size()];
        last = std::exchange(since_frame_, 0);
        // A single long one, as when a group shot begins, says little, two in a row say all.
        usual_ = std::max({median(last_), std::min(before, last), last / 8});
    }

    // ns; 0 where they are not long.
    [[nodiscard]] std::int64_t usual() const { return usual_ < long_ns ? 0 : usual_; }
    // From the beginning of one to that of the next.
    [[nodiscard]] std::int64_t interval() const { return 2 * usual(); }

  private:
    using Last = std::array<std::int64_t, 5>;

    static std::int64_t median(Last sorted) {
        const auto middle = sorted.begin() + sorted.size() / 2;
        std::nth_element(sorted.begin(), middle, sorted.end());
        return *middle;
    }

    Last last_{};
    std::size_t count_ = 0;
    std::int64_t since_frame_ = 0;
    std::int64_t usual_ = 0;
};

}  // namespace camdir::director
