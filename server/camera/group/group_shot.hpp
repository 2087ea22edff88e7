// The group shot: one camera that shows two to four players together.
#pragma once

#include <cstdint>
#include <span>

#include "camera/camera.hpp"
#include "camera/group/members.hpp"
#include "camera/group/outlook.hpp"
#include "camera/profile.hpp"
#include "camera/view.hpp"
#include "camera/window.hpp"
#include "freespace/space.hpp"

namespace camdir::camera {

// Everything that a group shot remembers between two frames. A value.
struct GroupState {
    bool started = false;  // false: the next step with a pose begins with a cut
    bool waiting = false;  // for a first pose, at a spawn point
    Vec3f position = Vec3f::Zero();
    Vec3f velocity = Vec3f::Zero();
    Vec3f goal = Vec3f::Zero();  // that the camera glides to
    Look look;
    Look look_rate;               // of yaw and pitch, rad/s
    MemberSet framed = 0;         // whom the viewpoint was chosen for
    float side = 0.0F;            // of the line of action
    float since_cut = 0.0F;       // s
    float incomplete_for = 0.0F;  // s: for so long somebody who lives is not shown
    float empty_for = 0.0F;       // s: likewise nobody
    float until_choice = 0.0F;    // s
    std::uint32_t phase = 0;      // any number: shots that begin together choose in different frames by it
    double time = 0.0;            // s: of the last step
};

// Moves the camera to `time`, later than the last step's. A window a member, at most max_members, those who
// matter most first: the poses that are known, as for step() of the tracker; without any after `time` the
// shot is causal. Of the profile it heeds vertical_fov, minimum_clearance, look_smoothing and turn_limit.
// `outlook` is memory, of this freespace: with that of the last step a step is fast.
//
// The camera stands or glides at lookouts that see all living members, with all of them in the picture: while
// it does, it moves and turns as little as keeps them there. Where it stops to do, it glides to another one
// nearby or cuts, but for some time after a cut. Where no lookout sees all it keeps who is seen in the
// picture, but never turns faster than 200 degrees a second for some of the members, and, soon after nobody
// is seen, cuts to those that matter more. Of two it stays on one side of the line between them, as long as
// anything else shows them.
//
// Guarantees: as step() of the tracker, but that a step may ask for the freespace's lookouts for the first
// time, which makes them and allocates, and what some of them see, which takes milliseconds each, once for a
// map. The first step of a shot that knows its future looks at all of it: milliseconds too.
//
// Flags: target_visible, all living members are in sight and in the picture; searching, not all of them;
// held, nobody lives or is in sight; target_absent, no member has a pose.
[[nodiscard]] Camera step(const freespace::Space& space, const Profile& profile,
                          std::span<const Window> members, double time, GroupState& state, Outlook& outlook);

// The same as go_on_from() of the tracker.
[[nodiscard]] bool go_on_from(const freespace::Space& space, const View& before, const View& now, double dt,
                              GroupState& state);

}  // namespace camdir::camera
