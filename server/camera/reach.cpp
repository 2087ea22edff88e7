#include "camera/reach.hpp"

#include "freespace/distance.hpp"
#include "freespace/visibility.hpp"

namespace camdir::camera {

std::optional<Candidate> reach(const freespace::Freespace& freespace, const PlayerTrack& track,
                               const Start& start, const Vec3f& target) {
    const freespace::Sight way = freespace::sight(freespace, start.position, target, 0.0F, start.slab);
    if (!way.clear) return std::nullopt;
    return look_up(freespace, track, target, way.triangle);
}

std::optional<Candidate> reach_shortened(const freespace::Freespace& freespace, const PlayerTrack& track,
                                         const Start& start, const Vec3f& target) {
    const freespace::Sight way = freespace::sight(freespace, start.position, target, 0.0F, start.slab);
    if (way.clear) return look_up(freespace, track, target, way.triangle);
    const Vec3f direction = (target - start.position).normalized();
    return reach(freespace, track, start, start.position + 0.5F * way.free_length * direction);
}

std::optional<Candidate> look_up(const freespace::Freespace& freespace, const PlayerTrack& track,
                                 const Vec3f& position, std::uint32_t near_slab) {
    const freespace::Distance free = freespace::distance(freespace, position, near_slab);
    if (!free.covered()) return std::nullopt;
    const freespace::Sight line = freespace::sight(freespace, position, track.anchor, 0.0F, free.triangle);
    return Candidate{position, free.triangle, free.value, line.clear ? line.clearance : 0.0F};
}

}  // namespace camdir::camera
