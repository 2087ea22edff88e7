// Arbitrary bytes are a scene that keeps its promises, or an error of one line.
#include <cstdint>
#include <cstdlib>
#include <span>

#include "scene/q3_scene.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto scene = camdir::scene::read_q3_scene(std::as_bytes(std::span(data, size)));
    if (!scene) {
        if (scene.error().message.empty()) std::abort();
        return 0;
    }
    for (const auto& triangle : scene->triangles) {
        for (const std::uint32_t corner : triangle) {
            if (corner >= scene->vertices.size() || !scene->bounds.contains(scene->vertices[corner]))
                std::abort();
        }
    }
    for (const auto& brush : scene->brushes) {
        if (std::size_t{brush.first_plane} + brush.plane_count > scene->planes.size()) std::abort();
    }
    return 0;
}
