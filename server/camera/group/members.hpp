// Where the players of a group are, now and in the next seconds.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
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
    // Seconds ahead of now; those after the first `foreseen` only where they are known.
    static constexpr std::array<float, 13> instants = {0.0F, 0.2F, 0.4F, 0.6F, 0.8F, 1.0F, 1.2F,
                                                       1.4F, 1.6F, 1.8F, 2.0F, 2.2F, 2.4F};
    static constexpr std::size_t foreseen = 4;

    struct Instant {
        std::array<Vec3f, max_members> eyes;  // of those who are present
        MemberSet present = 0;                // dead or alive
        MemberSet living = 0;
    };
    std::array<Instant, instants.size()> at;
    std::size_t known = 0;  // instants

    [[nodiscard]] const Instant& now() const { return at[0]; }
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

// What the windows, of at most max_members, say of `time` and after; without a future the players are
// taken to run on, as far as is free.
[[nodiscard]] Members members_at(const freespace::Space& space, std::span<const Window> windows, double time);

}  // namespace camdir::camera
