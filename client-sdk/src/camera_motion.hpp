// The motion of a camera between its frames: a curve without kinks. Pure.
#pragma once

#include <camera_director/camera_director.h>

#include <Eigen/Core>

namespace camdir::sdk {

// Per second: map units, and radians about the camera's own axes.
struct CameraVelocity {
    Eigen::Vector3d linear;
    Eigen::Vector3d angular;
};

// The way from one frame to the next, straight and along the shorter arc.
struct CameraStep {
    double seconds;  // > 0
    CameraVelocity velocity;
};
[[nodiscard]] CameraStep step_between(const cdir_camera& a, const cdir_camera& b, double seconds);

// The velocity of the parabola through the three frames of two steps in a row: at the frame between them, and
// at the last one. Limited so that a camera that comes to a standstill does not overshoot.
[[nodiscard]] CameraVelocity velocity_between(const CameraStep& before, const CameraStep& after);
[[nodiscard]] CameraVelocity velocity_after(const CameraStep& before, const CameraStep& last);

// One frame, and the camera's velocity there.
struct CameraState {
    const cdir_camera& camera;
    const CameraVelocity& velocity;
};

// The camera at `share` of the time from one frame to the next, 0 .. 1, which is `seconds`. Position and
// orientation are cubic and have the frames' velocities at the frames, field of view is linear, clearance is
// a lower bound, all else is a's.
//
// Every position lies on the straight way, or in one of the two balls that the frames' clearances say are
// free. Where those are too small for a cubic over the whole way, it takes up less of it at either end.
[[nodiscard]] cdir_camera camera_between(const CameraState& a, const CameraState& b, double seconds,
                                         double share);

}  // namespace camdir::sdk
