// What goes into a tracker and what comes out of it. Axes of poses and cameras: x forward, y left, z up.
#pragma once

#include <cstdint>

#include "base/geometry.hpp"

namespace camdir::camera {

// The player P at one instant: the paper's frame {o_P, x_P, y_P, z_P} (section 3).
struct Pose {
    Vec3f eye = Vec3f::Zero();              // o_P
    Quatf orientation = Quatf::Identity();  // x = the view direction, the paper's z_P
    Vec3f velocity = Vec3f::Zero();         // map units a second; zero when unknown
    bool alive = true;
    bool discontinuity = false;  // respawned or teleported since the pose before
};

enum Flag : std::uint32_t {
    cut = 1,             // a declared jump: do not interpolate from the frame before
    target_visible = 2,  // the segment from the camera to the player's eye lies in freespace
    searching = 4,       // on the way along the roadmap to a lost player
    target_absent = 8,   // no pose for the player: missing, or not a number
    held = 16,           // the camera keeps its place: dead player, or nowhere to go
};

// The objective of section 3, each term as it entered the sum; for tuning a profile from a log.
struct ObjectiveTerms {
    float visibility = 0.0F;  // c_vis, the factor
    float distance = 0.0F;
    float angle = 0.0F;
    float inertia_distance = 0.0F;
    float inertia_angle = 0.0F;
    float safety = 0.0F;
    float total = 0.0F;
};

struct Camera {
    Vec3f position = Vec3f::Zero();
    Quatf orientation = Quatf::Identity();  // horizon level: the y axis is horizontal
    float vertical_fov = 0.0F;              // radians
    float clearance = 0.0F;                 // free distance at `position`, map units
    std::uint32_t flags = 0;                // of Flag
    ObjectiveTerms objective;
};

}  // namespace camdir::camera
