// How a group shot's camera glides from one place to another.
#pragma once

#include "base/geometry.hpp"

namespace camdir::camera {

// Critically damped, and no faster than 350 units of 0.0254 m a second unless it begins so.
struct Glide {
    Vec3f position;
    Vec3f velocity;  // map units/s
    Vec3f goal;

    [[nodiscard]] bool rests(float unit) const;
    // A step of `dt` seconds later. `unit`: 0.0254 m in map units, as above.
    [[nodiscard]] Vec3f velocity_after(float dt, float unit) const;
};

// Where it is so many seconds later, if nothing is in its way.
[[nodiscard]] Glide after(Glide glide, float seconds, float unit);

}  // namespace camdir::camera
