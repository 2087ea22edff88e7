// Lookouts: places spread over the free space, and which of them see each other. They answer from where
// several points can be seen at once: by the sets of the lookouts nearest to these.
#pragma once

#include <array>
#include <bitset>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "base/lazy.hpp"
#include "freespace/freespace.hpp"

namespace camdir::freespace {

// Immutable but for what has been looked at, which is the same whenever and by whomever; thread-safe.
class Lookouts {
  public:
    static constexpr std::size_t limit = 2048;
    using Set = std::bitset<limit>;
    // The nearest of a point that it sees; fewer where there are not so many within `reach()`.
    struct Nearest {
        std::array<std::uint32_t, 12> lookouts;
        std::uint32_t count = 0;

        [[nodiscard]] std::span<const std::uint32_t> span() const& { return {lookouts.data(), count}; }
        std::span<const std::uint32_t> span() const&& = delete;  // of what is gone by then
    };

    // Vertices of the roadmap, the roomiest first, that keep 40 units of 0.0254 m from each other, or as much
    // more as leaves at most `limit` of them, and 8 units from the obstacles.
    explicit Lookouts(const Freespace& freespace);

    [[nodiscard]] std::span<const Vec3f> positions() const { return positions_; }
    // How far a lookout may be from a point that it is to stand for, map units.
    [[nodiscard]] float reach() const { return reach_; }

    // `point` in free space; `freespace` that of the constructor, as below.
    [[nodiscard]] Nearest nearest(const Freespace& freespace, const Vec3f& point) const;

    // The lookouts that `lookout` sees, by sight(), and itself. What was not asked before takes a sight for
    // each: milliseconds.
    [[nodiscard]] const Set& seen_from(const Freespace& freespace, std::uint32_t lookout) const;

    // The lookouts within `radius` of `point`, map units, that its nearest one sees; none where it has none.
    [[nodiscard]] Set around(const Freespace& freespace, const Vec3f& point, float radius) const;

    // The lookouts that probably see `point`: those that one of the nearest sees.
    [[nodiscard]] Set seeing(const Freespace& freespace, const Vec3f& point) const;

  private:
    std::vector<Vec3f> positions_;
    float reach_;
    std::unique_ptr<Lazy<Set>[]> seen_;  // by lookout
};

}  // namespace camdir::freespace
