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

// Told by what the bytes start with; text without a mark of its own by its first line or by the file's
// extension (.obj). A PLY is a mesh when its header promises faces. Nothing for what is neither; BSPs have
// marks of their own.
[[nodiscard]] Result<std::variant<std::monostate, MeshFormat, CloudFormat>> format_of(
    std::span<const std::byte> bytes, const std::string& extension);

}  // namespace camdir::scene
