// How shots may follow each other: the conventions of continuity editing, as costs.
#pragma once

#include "direction/footage.hpp"
#include "direction/rules.hpp"

namespace camdir::direction {

// More than any plan can be worth, in points: what breaks the grammar is chosen only where everything does.
inline constexpr double never = 1e6;

// A piece of so many beats, from a cut, or a jump of the camera, to the next; in points, 0 at the preferred
// length.
[[nodiscard]] double length_cost(const Grammar& grammar, Beat length);

// A cut at `beat` between the two rushes is a jump cut: both show the subject of one of them, from directions
// less than the grammar's angle apart. Precondition: beat < footage.beats().
[[nodiscard]] bool jump_cut(const Footage& footage, const Grammar& grammar, Beat beat, std::size_t from,
                            std::size_t to);

// Or would be one if nothing hid the subjects: whoever sees by the freespace may take somebody for hidden who
// is not. Likewise.
[[nodiscard]] bool may_be_jump_cut(const Footage& footage, const Grammar& grammar, Beat beat,
                                   std::size_t from, std::size_t to);

// A cut at `beat` crosses the line of action: the subjects are enemies in mutual sight, and the cameras are
// on different sides of the line through them, seen from above. Likewise.
[[nodiscard]] bool crosses_line(const Footage& footage, Beat beat, std::size_t from, std::size_t to);

// Or would if the two saw each other; or the cut is to a fixed camera, which cannot give way, while the
// moving one before is so near to the line, within 30 degrees, that it may come to be on its other side.
// Likewise.
[[nodiscard]] bool may_cross_line(const Footage& footage, Beat beat, std::size_t from, std::size_t to);

inline constexpr Beat shortest_piece = 15;

// A cut at `beat` leaves a shorter piece between itself and a jump of either camera: the one before jumped
// just now, or the one after soon will; of shots that are not shorter themselves. What is not known counts as
// none.
[[nodiscard]] bool jumped_just_before(const Footage& footage, Beat beat, std::size_t rush);
[[nodiscard]] bool jumps_soon_after(const Footage& footage, Beat beat, std::size_t rush);

inline constexpr double idle_speed = 32.0;  // units of 0.0254 m a second

// The subject is alive and stands about: slower than `slow` in every beat of the two seconds before `beat`
// and in sight of no enemy.
[[nodiscard]] bool stands_idle(const Footage& footage, Beat beat, std::size_t player, double slow);

}  // namespace camdir::direction
