// Euler angles of game engines.
#pragma once

namespace camdir::sdk {

// Stores the quaternion x, y, z, w of three angles in degrees: about z by yaw, then about y by pitch, then
// about x by roll.
void store_orientation(const float* pitch_yaw_roll, float* orientation);

}  // namespace camdir::sdk
