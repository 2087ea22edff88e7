#include "camera/reach.hpp"

#include <algorithm>

#include "freespace/distance.hpp"
#include "freespace/visibility.hpp"

namespace camdir::camera {
namespace {

constexpr float inside_ball = 0.9F;  // share of a ball's radius in which a beam surely starts
constexpr float share_of_room = 0.675F;

// A beam knows the clearance around a line of sight far better than a line does: the widest beam that matters
// first, then the narrowest that counts.
float sight_clearance(const freespace::Freespace& freespace, const MapProfile& profile,
                      const PlayerTrack& track, const Vec3f& position) {
    const float wide = beam_radius(profile, track);
    if (freespace::sight(freespace, position, track.anchor, wide).clear) {
        return wide;
    }
    const float narrow = std::min(profile.visibility_threshold, wide);
    const freespace::Sight line = freespace::sight(freespace, position, track.anchor, narrow);
    return line.clear ? std::max(line.clearance, narrow) : 0.0F;
}

Candidate candidate(const freespace::Freespace& freespace, const MapProfile& profile,
                    const PlayerTrack& track, const Vec3f& position, const freespace::Distance& free) {
    return {position, free.triangle, free.value, sight_clearance(freespace, profile, track, position)};
}

}  // namespace

float beam_radius(const MapProfile& profile, const PlayerTrack& track) {
    const float wanted = std::max(profile.minimum_clearance, profile.visibility_threshold);
    return std::min(wanted, inside_ball * track.clearance);
}

float kept_clearance(const MapProfile& profile, const PlayerTrack& track) {
    const float usual = Profile{}.minimum_clearance * profile.unit;
    return std::min(profile.minimum_clearance, std::max(usual, share_of_room * track.clearance));
}

std::optional<Candidate> reach(const freespace::Freespace& freespace, const MapProfile& profile,
                               const PlayerTrack& track, const Vec3f& start, const Vec3f& target) {
    const freespace::Distance free = freespace::distance(freespace, target);
    if (!free.covered()) return std::nullopt;
    const bool near = (target - start).norm() < inside_ball * free.value;
    if (!near && !freespace::sight(freespace, start, target).clear) return std::nullopt;
    return candidate(freespace, profile, track, target, free);
}

std::optional<Candidate> reach_shortened(const freespace::Freespace& freespace, const MapProfile& profile,
                                         const PlayerTrack& track, const Vec3f& start, const Vec3f& target) {
    const freespace::Sight way = freespace::sight(freespace, start, target);
    if (way.clear) return look_up(freespace, profile, track, target);
    const Vec3f direction = (target - start).normalized();
    return reach(freespace, profile, track, start, start + 0.5F * way.free_length * direction);
}

std::optional<Candidate> look_up(const freespace::Freespace& freespace, const MapProfile& profile,
                                 const PlayerTrack& track, const Vec3f& position) {
    const freespace::Distance free = freespace::distance(freespace, position);
    if (!free.covered()) return std::nullopt;
    return candidate(freespace, profile, track, position, free);
}

}  // namespace camdir::camera
