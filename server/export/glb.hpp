// Baked maps and their obstacles as glTF 2.0 files.
#pragma once

#include "base/error.hpp"
#include "base/file.hpp"
#include "freespace/freespace.hpp"
#include "scene/scene.hpp"

namespace camdir::exports {

// Binary glTF of the medial mesh, its roadmap and the spawn points. Vertices are those of the baked map, in
// map units with z up, with COLOR_0 by free distance and the attribute _FREE_DISTANCE; the root node
// transforms them to glTF's metres with y up. Its children: "medial mesh" (triangles) and "roadmap" (lines)
// where they are not empty, and one node per spawn point, whose x axis is the view direction. Fails when the
// file would exceed glTF's limit of 4 GB.
[[nodiscard]] Result<Bytes> to_glb(const freespace::Freespace& freespace);

// Binary glTF of the obstacles' surfaces, to look at: the node "obstacles", with positions in 16 bits within
// the vertices' bounds (KHR_mesh_quantization), below a root node as above. Fails when there are no
// triangles, and as above.
[[nodiscard]] Result<Bytes> to_glb(const scene::Scene& scene);

}  // namespace camdir::exports
