// The medial mesh as a PLY file.
#pragma once

#include "base/file.hpp"
#include "freespace/freespace.hpp"

namespace camdir::exports {

// Binary PLY: vertices x y z free_distance in map units, z up, and triangles.
[[nodiscard]] Bytes to_ply(const freespace::Freespace& freespace);

}  // namespace camdir::exports
