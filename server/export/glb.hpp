// The medial mesh, its roadmap and the spawn points as a glTF 2.0 file.
#pragma once

#include "base/error.hpp"
#include "base/file.hpp"
#include "freespace/freespace.hpp"

namespace camdir::exports {

// Binary glTF. Vertices are the baked map's own, in map units and z up, with COLOR_0 by free distance and
// _FREE_DISTANCE itself; the root node turns them to glTF's metres and y up. Under it: "medial mesh"
// (triangles), "roadmap" (lines) and a node a spawn point, whose x axis is the view direction. A mesh that
// has no triangles, or no roadmap, is left out. Fails where the file would pass glTF's limit of 4 GB.
[[nodiscard]] Result<Bytes> to_glb(const freespace::Freespace& freespace);

}  // namespace camdir::exports
