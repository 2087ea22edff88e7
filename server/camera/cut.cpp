#include "camera/cut.hpp"

#include <array>
#include <optional>

#include "camera/reach.hpp"
#include "camera/regain.hpp"
#include "camera/spot.hpp"

namespace camdir::camera {
namespace {

constexpr std::array shares = {1.0F, 0.9F, 0.75F, 0.5F};  // of the way to the best spot

// The nearest corner of the slabs round the anchor that keeps kept_clearance() and sees the anchor.
std::optional<Candidate> roadmap_spot(const freespace::Freespace& freespace, const MapProfile& profile,
                                      const PlayerTrack& track) {
    if (track.slab == freespace::none) return std::nullopt;
    const freespace::Triangle& triangle = freespace.triangles()[track.slab];
    std::optional<Candidate> nearest;
    float least = 0.0F;
    for (const std::uint32_t corner : {triangle.a, triangle.b, triangle.c}) {
        const Vec3f position = freespace.vertices()[corner].position();
        const float distance = (position - track.anchor).norm();
        if (nearest && distance >= least) continue;
        const std::optional<Candidate> candidate = look_up(freespace, profile, track, position);
        if (!candidate || !acceptable(profile, track, *candidate)) continue;
        nearest = candidate;
        least = distance;
    }
    return nearest;
}

}  // namespace

Candidate landing(const freespace::Freespace& freespace, const MapProfile& profile,
                  const PlayerTrack& track) {
    const Spot spot = spot_to_cut_to(freespace, profile, track);
    for (const float share : shares) {
        const Vec3f place = track.anchor + share * spot.offset;
        const auto candidate = look_up(freespace, profile, track, place);
        if (candidate && acceptable(profile, track, *candidate)) return *candidate;
    }
    if (const auto candidate = roadmap_spot(freespace, profile, track)) return *candidate;
    return {track.anchor, track.slab, track.clearance, track.clearance};
}

}  // namespace camdir::camera
