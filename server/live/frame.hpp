// The message `frame` of idl/live.md: poses and cameras, quantised.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>

#include "director/messages.hpp"

namespace camdir::live {

// Of positions, in map units: 2 mm, or 1/12 unit where the unit's length is not known.
[[nodiscard]] float position_step(float metres_per_unit);

// The rest of a unit quaternion without its largest component, each in `bits` bits, above them the index of
// that component. q and -q, which are the same rotation, give the same. bits: 1 to 20.
[[nodiscard]] std::uint64_t pack_rotation(const Quatf& rotation, int bits);

// x, y, z as signed numbers of 21 bits, x lowest; what lies beyond is clamped.
[[nodiscard]] std::uint64_t pack_position(const Vec3f& position, float step);

inline constexpr int player_rotation_bits = 10;
inline constexpr int camera_rotation_bits = 15;  // and movers

// The slot in the match's list of players; 255 is none.
using SlotOf = std::function<std::uint8_t(std::uint32_t player)>;
inline constexpr std::uint8_t no_slot = 255;

// Players without a slot are left out. `movers`: where they are, at most 65,535. `step`: of positions.
[[nodiscard]] std::string encode_frame(const director::PoseFrame& poses, const director::CameraFrame& cameras,
                                       std::span<const director::MoverPose> movers, float step,
                                       const SlotOf& slot_of);

}  // namespace camdir::live
