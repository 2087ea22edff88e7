// What moves in a map and is in the way: a door, a lift, a vehicle. Its shape, and where it is.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/geometry.hpp"

namespace camdir::freespace {

// Points with normal.dot(p) <= distance are inside. `normal` has length 1.
struct HalfSpace {
    Vec3f normal;
    float distance;

    bool operator==(const HalfSpace&) const = default;
};

// A bounded intersection of half spaces.
struct ConvexHull {
    std::vector<HalfSpace> half_spaces;  // 4 .. max_half_spaces
    Box3f bounds;                        // encloses it; follows from them

    bool operator==(const ConvexHull& other) const { return half_spaces == other.half_spaces; }
};

struct MoverBall {
    Vec3f centre;
    float radius;  // > 0

    bool operator==(const MoverBall&) const = default;
};

// The union of hulls and balls, in the mover's own frame: map units, from where the mover's position is. A
// pose rotates it about that origin, then moves it.
struct MoverShape {
    std::string name;  // of the map's brush model, "*3", or the game's own; unique in a map
    std::string kind;  // the entity's class, "func_door"; may be empty
    std::vector<ConvexHull> hulls;
    std::vector<MoverBall> balls;
    Vec3f rest = Vec3f::Zero();  // the position where the map puts it, unrotated

    bool operator==(const MoverShape&) const = default;
};

// Limits of what is read from outside.
inline constexpr std::size_t max_movers = 256;
inline constexpr std::size_t max_hulls = 256;  // and balls, of one mover
inline constexpr std::size_t max_half_spaces = 64;

// Where one mover is.
struct MoverPose {
    std::uint32_t mover = 0;  // its place in the list of shapes
    Vec3f position = Vec3f::Zero();
    Quatf orientation = Quatf::Identity();  // length 1
};

}  // namespace camdir::freespace
