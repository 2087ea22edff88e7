// The files of their own that a glTF keeps its numbers in.
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

// The buffers of a .gltf or .glb that are neither in it nor data URIs. Fails for JSON that is broken or
// deeply nested, and for addresses that are no relative path within the glTF's folder.
[[nodiscard]] Result<std::vector<GltfBuffer>> gltf_buffers(std::span<const std::byte> bytes);

}  // namespace camdir::scene
