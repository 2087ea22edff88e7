#include "camera/reach.hpp"

#include <algorithm>

#include "camera/evade.hpp"

namespace camdir::camera {
namespace {

constexpr float share_of_room = 0.675F;

// A beam knows the clearance around a line of sight far better than a line does: the widest beam that matters
// first, then the narrowest that counts.
float sight_clearance(const freespace::Space& space, const MapProfile& profile, const PlayerTrack& track,
                      const Vec3f& position, freespace::RecentBalls* recent) {
    const float wide = beam_radius(profile, track);
    const bool clear = recent != nullptr ? freespace::is_clear(space, position, track.anchor, wide, *recent)
                                         : freespace::sight(space, position, track.anchor, wide).clear;
    if (clear) return wide;
    const float narrow = std::min(profile.visibility_threshold, wide);
    const freespace::Sight line = freespace::sight(space, position, track.anchor, narrow);
    return line.clear ? std::max(line.clearance, narrow) : 0.0F;
}

Candidate candidate(const freespace::Space& space, const MapProfile& profile, const PlayerTrack& track,
                    const Vec3f& position, const freespace::Distance& free,
                    freespace::RecentBalls* recent = nullptr) {
    return {position, free.triangle, free.value, sight_clearance(space, profile, track, position, recent),
            room_soon(space, position, std::min(free.value, profile.minimum_clearance))};
}

}  // namespace

float beam_radius(const MapProfile& profile, const PlayerTrack& track) {
    const float wanted = std::max(profile.minimum_clearance, profile.visibility_threshold);
    return std::min(wanted, freespace::surely_inside * track.clearance);
}

float kept_clearance(const MapProfile& profile, const PlayerTrack& track) {
    const float usual = Profile{}.minimum_clearance * profile.unit;
    return std::min(profile.minimum_clearance, std::max(usual, share_of_room * track.clearance));
}

std::optional<Candidate> reach(const freespace::Space& space, const MapProfile& profile,
                               const PlayerTrack& track, const Vec3f& start, const Vec3f& target,
                               freespace::RecentBalls* recent) {
    const freespace::Distance free = freespace::distance(space, target);
    if (!free.covered()) return std::nullopt;
    const bool near = (target - start).norm() < freespace::surely_inside * free.value;
    if (!near && !freespace::sight(space.map(), start, target).clear) return std::nullopt;
    if (!space.lets_pass(start, target)) return std::nullopt;
    return candidate(space, profile, track, target, free, recent);
}

std::optional<Candidate> reach_shortened(const freespace::Space& space, const MapProfile& profile,
                                         const PlayerTrack& track, const Vec3f& start, const Vec3f& target) {
    const freespace::Sight way = freespace::sight(space.map(), start, target);
    const freespace::MoverSweep step = space.step(start, target);
    if (way.clear && step.clear) return look_up(space, profile, track, target);
    const Vec3f direction = (target - start).normalized();
    const float until_mover = step.free_share * (target - start).norm();
    const float free = step.clear ? way.free_length : std::min(way.free_length, until_mover);
    return reach(space, profile, track, start, start + 0.5F * free * direction);
}

std::optional<Candidate> look_up(const freespace::Space& space, const MapProfile& profile,
                                 const PlayerTrack& track, const Vec3f& position) {
    const freespace::Distance free = freespace::distance(space, position);
    if (!free.covered()) return std::nullopt;
    return candidate(space, profile, track, position, free);
}

}  // namespace camdir::camera
