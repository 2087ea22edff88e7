// The separate files that hold the numbers of a glTF.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/error.hpp"

namespace camdir::scene {

struct GltfBuffer {
    std::string uri;   // as the file writes it
    std::string path;  // relative to the glTF file
    std::uint64_t byte_length;
};

[[nodiscard]] bool is_glb(std::span<const std::byte> bytes);

// The buffers of a .gltf or .glb that are neither in it nor data URIs. Fails for broken or deeply nested
// JSON, and for URIs other than relative paths within the glTF's folder.
[[nodiscard]] Result<std::vector<GltfBuffer>> gltf_buffers(std::span<const std::byte> bytes);

}  // namespace camdir::scene
