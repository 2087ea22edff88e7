// Shortening a move into freespace (section 5.3): which places the camera can reach in one step.
#pragma once

#include <optional>

#include "camera/objective.hpp"
#include "camera/player.hpp"
#include "camera/profile.hpp"
#include "freespace/space.hpp"

namespace camdir::camera {

// The radius of the beams that the camera wants between itself and the player: what it keeps from obstacles
// anyway, but no more than the player has.
[[nodiscard]] float beam_radius(const MapProfile& profile, const PlayerTrack& track);

// What the camera keeps from obstacles: the profile's minimum clearance, but no more than a share of what the
// player has, where that is more than usual cameras keep.
[[nodiscard]] float kept_clearance(const MapProfile& profile, const PlayerTrack& track);

// How far before the end of a free beam a place lies, in units of 0.0254 m.
inline constexpr float inside_beam = 2.0F;

// `target`, if the whole step from `start` to it is free. `recent`: balls near the line of sight, if any are
// known; those that it takes are added.
[[nodiscard]] std::optional<Candidate> reach(const freespace::Space& space, const MapProfile& profile,
                                             const PlayerTrack& track, const Vec3f& start,
                                             const Vec3f& target, freespace::RecentBalls* recent = nullptr);

// The same, and when the step leaves the freespace on its way the point half-way to where it leaves.
[[nodiscard]] std::optional<Candidate> reach_shortened(const freespace::Space& space,
                                                       const MapProfile& profile, const PlayerTrack& track,
                                                       const Vec3f& start, const Vec3f& target);

// The candidate with its distances looked up; none when no slab covers it.
[[nodiscard]] std::optional<Candidate> look_up(const freespace::Space& space, const MapProfile& profile,
                                               const PlayerTrack& track, const Vec3f& position);

}  // namespace camdir::camera
