// The tracker: one shot, one player, one camera. The paper's section 5.3.
#pragma once

#include <cstdint>

#include "camera/camera.hpp"
#include "camera/profile.hpp"
#include "freespace/freespace.hpp"
#include "freespace/roadmap.hpp"

namespace camdir::camera {

// Everything that a shot remembers between two poses. A value: copy it to branch, replace it to restart.
struct ShotState {
    bool started = false;  // false: the next step begins with a cut
    // ...
};

// Memory for the steps of any number of shots on one map, one after the other; one thread at a time.
class Scratch {
  public:
    explicit Scratch(const freespace::Freespace& freespace) : roadmap(freespace) {}
    freespace::RoadmapSearch roadmap;
};

// Moves the camera by one pose. `pose` is null when the player has none in this frame. `dt` is the time
// since the shot's last step in seconds, by the game's clock; <= 0 or not finite counts as one frame of 60
// Hz.
//
// Guarantees: the camera stays in freespace and moves through freespace, except in a step flagged `cut`;
// never a number that is not finite; the same arguments give the same result. Does not allocate, reads
// no clock.
[[nodiscard]] Camera step(const freespace::Freespace& freespace, const Profile& profile, const Pose* pose,
                          double dt, ShotState& state, Scratch& scratch);

}  // namespace camdir::camera
