#include "camera/search.hpp"

#include <algorithm>
#include <cstddef>

#include "freespace/visibility.hpp"

namespace camdir::camera {
namespace {

constexpr std::size_t looked_ahead = 4;  // vertices of the path that a shortcut may reach

}  // namespace

Vec3f next_on_the_way(const freespace::Freespace& freespace, const PlayerTrack& track, const Start& start,
                      freespace::RoadmapSearch& roadmap) {
    const freespace::RoadmapPath& path = roadmap.find(start.position, track.anchor);
    if (!path.found) return start.position;
    if (path.vertices.empty()) return track.anchor;
    for (std::size_t i = std::min(looked_ahead, path.vertices.size()); i-- > 1;) {
        const Vec3f vertex = freespace.vertices()[path.vertices[i]].position();
        if (freespace::sight(freespace, start.position, vertex, 0.0F, start.slab).clear) return vertex;
    }
    return freespace.vertices()[path.vertices.front()].position();
}

}  // namespace camdir::camera
