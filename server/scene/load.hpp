// Opens a map: the one place that chooses the reader for a format.
#pragma once

#include <cstdint>
#include <string>

#include "base/error.hpp"
#include "scene/scene.hpp"

namespace camdir::scene {

// `source` is a file, or `archive.pk3:maps/name.bsp`: a BSP, a mesh (OBJ, PLY with faces, STL, glTF 2), or a
// point cloud (PCD, PLY without faces, XYZ, LAS). The content decides the format, and the extension where the
// content does not. The options' seeds join the spawn points.
// Errors name the file, the lump or byte offset, and what was expected. What a file unpacks into is limited
// before memory is allocated for it. Thread-safe.
[[nodiscard]] Result<Scene> load(const std::string& source, const ReadOptions& options = {});

// xxh3-64 of the map's bytes (Scene::source_hash) without reading the map further: of a glTF whose buffers
// are files of their own, of its bytes and then theirs.
[[nodiscard]] Result<std::uint64_t> hash_source(const std::string& source);

}  // namespace camdir::scene
