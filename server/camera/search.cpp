#include "camera/search.hpp"

#include <cstddef>

#include "freespace/visibility.hpp"

namespace camdir::camera {

Vec3f next_on_the_way(const freespace::Freespace& freespace, const MapProfile& profile,
                      const PlayerTrack& track, const Vec3f& start, freespace::RoadmapSearch& roadmap) {
    const freespace::RoadmapPath& path = roadmap.find(start, track.anchor);
    if (!path.found) return start;
    if (path.vertices.empty()) return track.anchor;
    Vec3f next = freespace.vertices()[path.vertices.front()].position();
    for (std::size_t i = 1; i < path.vertices.size(); i *= 2) {
        const Vec3f vertex = freespace.vertices()[path.vertices[i]].position();
        if (!freespace::sight(freespace, start, vertex, profile.minimum_clearance).clear) break;
        next = vertex;
    }
    return next;
}

}  // namespace camdir::camera
