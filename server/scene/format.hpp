// Which format a map is in.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <variant>

#include "scene/cloud/read_scene.hpp"
#include "scene/mesh/read_scene.hpp"

namespace camdir::scene {

// The first bytes decide; for text without a signature its first line or the file's extension. A PLY is a
// mesh when its header declares faces. monostate: neither; BSPs have signatures of their own.
[[nodiscard]] Result<std::variant<std::monostate, MeshFormat, CloudFormat>> format_of(
    std::span<const std::byte> bytes, const std::string& extension);

}  // namespace camdir::scene
