// What a scene promises, whatever bytes it was read from.
#pragma once

#include <cstdint>
#include <cstdlib>

#include "base/error.hpp"
#include "scene/scene.hpp"

namespace camdir::fuzz {

// A scene that keeps its promises, or an error with a message; anything else aborts.
inline void check(const Result<scene::Scene>& scene) {
    if (!scene) {
        if (scene.error().message.empty()) std::abort();
        return;
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
    for (const auto& mover : scene->movers) {
        if (mover.parts.empty() || !mover.rest.allFinite()) std::abort();
        for (const auto& part : mover.parts)
            if (part.planes.empty() || part.bounds.isEmpty()) std::abort();
    }
}

}  // namespace camdir::fuzz
