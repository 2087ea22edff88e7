// Visibility along a line of sight: the paper's section 5.2.
#pragma once

#include "freespace/freespace.hpp"

namespace camdir::freespace {

struct Sight {
    bool clear = false;        // the whole segment lies in freespace (with the asked radius around it)
    float free_length = 0.0F;  // how far from `from` the segment is known to be free; its length when clear
    float clearance = 0.0F;    // lower bound of the clearance along the free part; > 0 when clear
    std::uint32_t triangle = none;  // slab of the last free point: tracking state of its end
};

// Walks from ball to ball of the representation along the segment. Conservative: `clear` is never wrong,
// whatever the input; a segment through a gap between slabs is reported as blocked. `radius` >= 0 asks
// for a beam of that radius instead of a line. `previous` is the slab of `from`. Points that are not
// finite give a blocked Sight of free length 0. Thread-safe, does not allocate.
[[nodiscard]] Sight sight(const Freespace& freespace, const Vec3f& from, const Vec3f& to, float radius = 0.0F,
                          std::uint32_t previous = none);

}  // namespace camdir::freespace
