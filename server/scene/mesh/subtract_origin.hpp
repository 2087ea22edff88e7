// Georeferenced meshes: Assimp keeps positions in single precision, which at UTM coordinates is up to half a
// metre.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/geometry.hpp"

namespace camdir::scene {

// The same file with `origin` subtracted from its positions, in double precision. Errors name the line.
[[nodiscard]] Result<Bytes> subtract_origin_from_obj(std::span<const std::byte> bytes, const Vec3d& origin);

// Nothing when the positions are not text or double: there is no precision to save.
[[nodiscard]] Result<std::optional<Bytes>> subtract_origin_from_ply(std::span<const std::byte> bytes,
                                                                    const Vec3d& origin);

}  // namespace camdir::scene
