// Opens a map: the one place that chooses the reader for a format.
#pragma once

#include <cstdint>
#include <string>

#include "base/error.hpp"
#include "scene/scene.hpp"

namespace camdir::scene {

// `source` is a file, or `archive.pk3:maps/name.bsp`. Formats are told by content, not by name.
// Errors name the file, the lump or byte offset, and what was expected; memory is bounded by a small
// multiple of the file's size. Thread-safe.
[[nodiscard]] Result<Scene> load(const std::string& source);

// xxh3-64 of the map's bytes (Scene::source_hash) without reading the map further.
[[nodiscard]] Result<std::uint64_t> hash_source(const std::string& source);

}  // namespace camdir::scene
