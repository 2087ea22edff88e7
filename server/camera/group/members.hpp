// Where the players of a group are, now and in the next seconds.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "camera/window.hpp"
#include "freespace/space.hpp"

namespace camdir::camera {

inline constexpr std::size_t max_members = 4;

// A set of members. The most important one has the highest bit: of two sets the greater number shows those
// who matter more.
using MemberSet = std::uint32_t;
[[nodiscard]] constexpr MemberSet only(std::size_t member) {
    return 1U << (max_members - 1 - member);
}

struct Members {
    static constexpr std::size_t most = 49;  // instants

    struct Instant {
        std::array<Vec3f, max_members> eyes;  // of those who are present
        MemberSet present = 0;                // dead or alive
        MemberSet living = 0;
    };
    std::array<Instant, most> at;     // now and soon
    std::array<float, most> ahead{};  // s, from now; ascending from 0
    std::size_t known = 0;            // instants
    // at[i] of i > 0 is whole twentieth of a second `first` + i of the recorded future, by any clock that
    // does not change; otherwise the players are taken to run on.
    bool is_recorded = false;
    std::int64_t first = 0;

    [[nodiscard]] const Instant& now() const { return at[0]; }
    // Of the instants, those no later.
    [[nodiscard]] std::size_t until(float seconds) const {
        return static_cast<std::size_t>(
            std::upper_bound(ahead.begin(), ahead.begin() + static_cast<std::ptrdiff_t>(known), seconds) -
            ahead.begin());
    }
    // Who lives at some known instant.
    [[nodiscard]] MemberSet soon_living() const {
        MemberSet living = 0;
        for (std::size_t i = 0; i < known; ++i)
            living |= at[i].living;
        return living;
    }
};

// The eyes of some living members.
class Eyes {
  public:
    Eyes(const Members::Instant& instant, MemberSet set) {
        for (std::size_t member = 0; member < max_members; ++member)
            if ((set & instant.living & only(member)) != 0) eyes_[count_++] = instant.eyes[member];
    }
    [[nodiscard]] std::span<const Vec3f> span() const { return {eyes_.data(), count_}; }

  private:
    std::array<Vec3f, max_members> eyes_;
    std::size_t count_ = 0;
};

// What the windows, of at most max_members, say of `time` and of the 2.4 s after, as far as they go; where
// they go less far than 0.7 s, of 0.6 s every 0.2 s: players are taken to run on, as far as is free.
[[nodiscard]] Members members_at(const freespace::Space& space, std::span<const Window> windows, double time);

}  // namespace camdir::camera
