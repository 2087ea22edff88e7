#include "camera/cut.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "camera/evade.hpp"
#include "camera/reach.hpp"
#include "camera/regain.hpp"
#include "freespace/roadmap.hpp"

namespace camdir::camera {
namespace {

constexpr std::array shares = {1.0F, 0.9F, 0.75F, 0.5F};  // of the way to the best spot

// The nearest corner of the slabs round the anchor that keeps kept_clearance() and sees the anchor.
std::optional<Candidate> roadmap_spot(const freespace::Space& space, const MapProfile& profile,
                                      const PlayerTrack& track) {
    if (track.slab == freespace::none) return std::nullopt;
    const freespace::Triangle& triangle = space.map().triangles()[track.slab];
    std::optional<Candidate> nearest;
    float least = 0.0F;
    for (const std::uint32_t corner : {triangle.a, triangle.b, triangle.c}) {
        const Vec3f position = space.map().vertices()[corner].position();
        const float distance = (position - track.anchor).norm();
        if (nearest && distance >= least) continue;
        const std::optional<Candidate> candidate = look_up(space, profile, track, position);
        if (!candidate || !acceptable(profile, track, *candidate)) continue;
        nearest = candidate;
        least = distance;
    }
    return nearest;
}

// Where a mover is over the anchor: the nearest vertex of the roadmap in no mover's way, if possible one that
// has kept_clearance().
std::optional<Candidate> free_vertex(const freespace::Space& space, const MapProfile& profile,
                                     const PlayerTrack& track) {
    const float wanted = kept_clearance(profile, track);
    std::uint32_t nearest = freespace::none;
    float least = 0.0F;
    float most_room = 0.0F;
    const auto vertices = space.map().vertices();
    for (std::uint32_t i = 0; i < vertices.size(); ++i) {
        if (!freespace::on_roadmap(vertices[i]) || space.map().incident(i).empty()) continue;
        const float distance = (vertices[i].position() - track.anchor).norm();
        if (nearest != freespace::none && distance >= least && most_room >= wanted) continue;
        const float room =
            room_soon(space, vertices[i].position(), std::min(vertices[i].free_distance, wanted));
        if (room < most_room || room <= 0.0F || (room == most_room && distance >= least)) continue;
        nearest = i;
        least = distance;
        most_room = room;
    }
    if (nearest == freespace::none) return std::nullopt;
    return look_up(space, profile, track, vertices[nearest].position());
}

}  // namespace

Candidate landing(const freespace::Space& space, const MapProfile& profile, const PlayerTrack& track,
                  const LineOfAction* line) {
    const Spot spot = spot_to_cut_to(space, profile, track, line);
    for (const float share : shares) {
        const Vec3f place = track.anchor + share * spot.offset;
        const auto candidate = look_up(space, profile, track, place);
        if (candidate && acceptable(profile, track, *candidate)) return *candidate;
    }
    if (const auto candidate = roadmap_spot(space, profile, track)) return *candidate;
    const Candidate anchor{track.anchor, track.slab, track.clearance, track.clearance, track.clearance};
    if (!space.has_movers() || freespace::distance(space, track.anchor).covered()) return anchor;
    return free_vertex(space, profile, track).value_or(anchor);
}

}  // namespace camdir::camera
