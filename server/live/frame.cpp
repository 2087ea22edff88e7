#include "live/frame.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "recording/bytes.hpp"

namespace camdir::live {
namespace {

constexpr std::uint64_t kind_frame = 1;
constexpr double step_m = 0.002;
constexpr float step_of_unknown_unit = 1.0F / 12.0F;
constexpr int position_bits = 21;

void put_player(recording::ByteSink& sink, const director::PlayerPose& pose, std::uint8_t slot, float step) {
    sink.fixed(slot, 1);
    sink.fixed(pose.flags & 0xffU, 1);
    sink.fixed(pack_position(pose.eye, step), 8);
    sink.fixed(pack_rotation(pose.orientation, player_rotation_bits), 4);
}

void put_camera(recording::ByteSink& sink, const director::ShotCamera& camera, std::uint8_t target,
                float step) {
    const float fov = std::clamp(camera.vertical_fov / std::numbers::pi_v<float>, 0.0F, 1.0F);
    sink.fixed(camera.camera_id, 4);
    sink.fixed(target, 1);
    sink.fixed(camera.flags & 0xffU, 1);
    sink.fixed(static_cast<std::uint64_t>(std::lround(fov * 65535.0F)), 2);
    sink.fixed(pack_position(camera.position, step), 8);
    sink.fixed(pack_rotation(camera.orientation, camera_rotation_bits), 6);
}

void put_mover(recording::ByteSink& sink, const director::MoverPose& mover, float step) {
    sink.fixed(mover.mover_id, 4);
    sink.fixed(pack_position(mover.position, step), 8);
    sink.fixed(pack_rotation(mover.orientation, camera_rotation_bits), 6);
}

}  // namespace

float position_step(float metres_per_unit) {
    if (!(metres_per_unit > 0.0F)) return step_of_unknown_unit;
    return static_cast<float>(step_m / static_cast<double>(metres_per_unit));
}

std::uint64_t pack_rotation(const Quatf& rotation, int bits) {
    const std::array parts = {rotation.x(), rotation.y(), rotation.z(), rotation.w()};
    const auto magnitude = [](float a, float b) { return std::abs(a) < std::abs(b); };
    const auto largest = std::max_element(parts.begin(), parts.end(), magnitude) - parts.begin();
    const float sign = parts[static_cast<std::size_t>(largest)] < 0.0F ? -1.0F : 1.0F;
    const auto top = static_cast<float>((1U << bits) - 1U);
    auto packed = static_cast<std::uint64_t>(largest) << (3 * bits);
    int shift = 0;
    for (std::ptrdiff_t i = 0; i < 4; ++i) {
        if (i == largest) continue;
        // The other three are within +-sqrt(1/2).
        const float part = sign * parts[static_cast<std::size_t>(i)] / std::numbers::sqrt2_v<float> + 0.5F;
        packed |= static_cast<std::uint64_t>(std::lround(std::clamp(part, 0.0F, 1.0F) * top)) << shift;
        shift += bits;
    }
    return packed;
}

std::uint64_t pack_position(const Vec3f& position, float step) {
    constexpr double limit = (1 << (position_bits - 1)) - 1;
    constexpr std::uint64_t mask = (std::uint64_t{1} << position_bits) - 1;
    std::uint64_t packed = 0;
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
        const double steps = static_cast<double>(position[axis]) / static_cast<double>(step);
        const auto whole = static_cast<std::int64_t>(std::llround(std::clamp(steps, -limit, limit)));
        packed |= (static_cast<std::uint64_t>(whole) & mask) << (axis * position_bits);
    }
    return packed;
}

std::string encode_frame(const director::PoseFrame& poses, const director::CameraFrame& cameras,
                         std::span<const director::MoverPose> movers, float step, const SlotOf& slot_of) {
    recording::ByteSink players;
    std::uint64_t player_count = 0;
    for (const director::PlayerPose& pose : poses.poses) {
        const std::uint8_t slot = slot_of(pose.player_id);
        if (slot == no_slot) continue;
        put_player(players, pose, slot, step);
        ++player_count;
    }
    recording::ByteSink sink;
    sink.fixed(kind_frame, 1);
    sink.fixed(0, 1);
    sink.fixed(player_count, 2);
    sink.fixed(cameras.cameras.size(), 2);
    sink.fixed(movers.size(), 2);
    sink.fixed(poses.frame_number, 4);
    sink.fixed(static_cast<std::uint64_t>(poses.frame_time), 8);
    sink.fixed(static_cast<std::uint64_t>(poses.source_time), 8);
    sink.append(players.bytes);
    for (const director::ShotCamera& camera : cameras.cameras)
        put_camera(sink, camera, slot_of(camera.target), step);
    for (const director::MoverPose& mover : movers)
        put_mover(sink, mover, step);
    return {reinterpret_cast<const char*>(sink.bytes.data()), sink.bytes.size()};
}

}  // namespace camdir::live
