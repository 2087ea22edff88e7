// Euler angles of game engines.
#pragma once

namespace camdir::sdk {

// Of three angles in degrees to the quaternion x, y, z, w: about z by yaw, then about y by pitch, then about
// x by roll.
void store_orientation(const float* pitch_yaw_roll, float* orientation);

}  // namespace camdir::sdk
