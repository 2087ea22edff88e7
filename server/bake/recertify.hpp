// The last look at what is written: every slab of a baked map against the obstacles, from nothing.
#pragma once

#include "bake/geometry/obstacles.hpp"
#include "bake/stage.hpp"
#include "freespace/freespace.hpp"

namespace camdir::bake {

// Fails when a ball of any slab, made larger by `offset`, reaches deeper than `tolerance` into an obstacle
// (all in map units). Trusts nothing that the stages before it know: the certification and the reduction
// keep slabs free one change at a time, and this is what holds of their sum. `source` names the map in the
// error, which says where the first such triangle is. `tolerance` is for rounding: > 0.
[[nodiscard]] Result<void> recertify(const freespace::Contents& contents, const Obstacles& obstacles,
                                     double offset, double tolerance, const std::string& source,
                                     Stage& stage);

}  // namespace camdir::bake
