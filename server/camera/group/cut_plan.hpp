// The best sequence of cuts among places that show a group at known instants.
#pragma once

#include <cstdint>
#include <span>

#include "camera/group/members.hpp"

namespace camdir::camera {

// By instant a bit: all who are wanted are shown then.
using Shows = std::uint64_t;
static_assert(Members::most <= 64);

struct CutPlace {
    std::uint32_t lookout;
    Shows shows;
    float cost;  // s, of a cut to it
};

// Instant i of the group lasts weights[i] seconds; instants begin at times[i], s, ascending. Of each the most
// time for which a camera that cuts there, to one of the places, shows the group from then on, less the costs
// of that cut and of those after it: from one to the next it takes `shortest` seconds at least. At most
// Members::most instants and freespace::Lookouts::limit places, at least one.
void plan_cuts(std::span<const CutPlace> places, std::span<const float> times, std::span<const float> weights,
               float shortest, std::span<float> best);

}  // namespace camdir::camera
