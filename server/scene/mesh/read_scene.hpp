// Meshes through Assimp: OBJ, PLY, STL, glTF 2.
#pragma once

#include <assimp/scene.h>

#include <cstddef>
#include <map>
#include <span>
#include <string>

#include "base/error.hpp"
#include "scene/read_options.hpp"
#include "scene/scene.hpp"

namespace camdir::scene {

enum class MeshFormat { obj, ply, stl, gltf, glb };

// By the names that the mesh's file uses for them.
using Companions = std::map<std::string, std::span<const std::byte>>;

// The triangles of all nodes, each where its node puts it. Sees no file but `companions`. Skipped and
// counted: triangles without area, points and lines. Refused: no triangles, positions that are not finite,
// broken indices, positions too far out for single precision (which OBJ, and PLY of text or doubles, may
// exceed: the origin is subtracted before they are rounded). Name, source, hash and spawn points are left
// empty.
[[nodiscard]] Result<Scene> read_mesh_scene(std::span<const std::byte> bytes, MeshFormat format,
                                            const Companions& companions, const ReadOptions& options);

// The second half of it: from what Assimp read, in single precision.
[[nodiscard]] Result<Scene> mesh_scene_of(const aiScene& imported, MeshFormat format,
                                          const ReadOptions& options);

}  // namespace camdir::scene
