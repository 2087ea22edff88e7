#include "camera/search.hpp"

#include <cstddef>

namespace camdir::camera {

Vec3f next_on_the_way(const freespace::Space& space, const MapProfile& profile, const PlayerTrack& track,
                      const Vec3f& start, freespace::RoadmapSearch& roadmap) {
    const freespace::RoadmapPath& path = roadmap.find(start, track.anchor, space);
    if (!path.found) return start;
    if (path.vertices.empty()) return track.anchor;
    Vec3f next = space.map().vertices()[path.vertices.front()].position();
    for (std::size_t i = 1; i < path.vertices.size(); i *= 2) {
        const Vec3f vertex = space.map().vertices()[path.vertices[i]].position();
        if (!freespace::sight(space, start, vertex, profile.minimum_clearance).clear) break;
        next = vertex;
    }
    return next;
}

}  // namespace camdir::camera
