// The text that Assimp reads. Georeferenced meshes: Assimp keeps positions in single precision, which at UTM
// coordinates is up to half a metre.
#pragma once

#include <cstddef>
#include <span>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/geometry.hpp"

namespace camdir::scene {

// The same file with `origin` subtracted from its positions, in double precision. Errors name the line.
[[nodiscard]] Result<Bytes> subtract_origin_from_obj(std::span<const std::byte> bytes, const Vec3d& origin);

// Whether the positions are more precise than single precision, so that an origin can be subtracted from
// them.
[[nodiscard]] Result<bool> keeps_double_precision(std::span<const std::byte> ply);

// A PLY mesh as OBJ, with `origin` subtracted. Assimp's own reader of PLY trusts the file's counts and
// indices.
[[nodiscard]] Result<Bytes> ply_to_obj(std::span<const std::byte> ply, const Vec3d& origin);

}  // namespace camdir::scene
