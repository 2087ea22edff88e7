// From which lookouts all of a group are shown, at many instants. Remembers what was found out: of a future
// that is known, every instant is asked about again and again until it has come.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "base/geometry.hpp"
#include "camera/group/framing.hpp"
#include "camera/group/members.hpp"
#include "freespace/freespace.hpp"
#include "freespace/lookouts.hpp"

namespace camdir::camera {

// What it answers is the same whatever it remembers, but between instants that have changed. One thread at a
// time. 80 kB.
class Outlook {
  public:
    // The lookouts from which a picture can hold the eyes, at most max_members of them, and sights to all are
    // free, among those that probably see them; without eyes all lookouts. Instants of which many are asked
    // about in turn have consecutive numbers, of which the last 256 are remembered. Valid until the next
    // call; always of the same freespace.
    [[nodiscard]] const freespace::Lookouts::Set& showing(const freespace::Freespace& freespace,
                                                          const PictureShape& picture,
                                                          std::span<const Vec3f> eyes, std::size_t number);

    // Likewise of an instant between two of which it is known: which of those that show the eyes at one of
    // these alone do. Far fewer are looked at.
    [[nodiscard]] const freespace::Lookouts::Set& showing_between(const freespace::Lookouts::Set& before,
                                                                  const freespace::Lookouts::Set& after,
                                                                  const freespace::Freespace& freespace,
                                                                  const PictureShape& picture,
                                                                  std::span<const Vec3f> eyes,
                                                                  std::size_t number);

  private:
    struct Answer {
        std::array<Vec3f, max_members> eyes;
        std::size_t count = max_members + 1;  // of the eyes: there is no answer yet
        PictureShape picture;
        freespace::Lookouts::Set showing;
        bool is_between = false;

        [[nodiscard]] bool is_of(const PictureShape& asked_for, std::span<const Vec3f> asked,
                                 bool between) const;
    };
    static constexpr std::size_t remembered = 256;

    // `look` says what is not remembered.
    template <class Look>
    const freespace::Lookouts::Set& recall(const PictureShape& picture, std::span<const Vec3f> eyes,
                                           std::size_t number, bool between, const Look& look);

    std::array<Answer, remembered> answers_;  // by number
};

}  // namespace camdir::camera
