// What it costs to see the player from each direction of the grid, as if all of them were free.
#pragma once

#include <span>

#include "camera/directions.hpp"
#include "camera/plan.hpp"
#include "camera/profile.hpp"

namespace camdir::camera {

// By bin. A direction that must not be used costs `forbidden` or more.
using DirectionCosts = std::array<float, DirectionGrid::size>;
inline constexpr float forbidden = 1e9F;

// At the knot that begins with sample `first` of the plan: being off the spot behind the player, by more than
// the profile's swing forbidden; looking down from above; and, weighed at the samples up to the next knot,
// seeing the player from the side.
void weigh_directions(const MapProfile& profile, const Plan& plan, std::size_t first, DirectionCosts& costs);

// Adds, for other players whose eyes are at these offsets from the player's, what a body on the line of sight
// or beside it costs: `cost` for one right on it that is no farther away than the camera would be.
void add_bodies(const MapProfile& profile, std::span<const Vec3f> offsets, float cost, DirectionCosts& costs);

// Adds what turning to a direction costs, `cost` for one bin's width, from `from` (unit, from the eye).
void add_turn(const Vec3f& from, float cost, DirectionCosts& costs);

}  // namespace camdir::camera
