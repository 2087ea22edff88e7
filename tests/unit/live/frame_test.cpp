// Frames against a decoder of their own: what idl/live.md says, bit by bit.
#include "live/frame.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <numbers>
#include <random>
#include <span>
#include <string>

namespace camdir::live {
namespace {

Vec3f unpack_position(std::uint64_t packed, float step) {
    Vec3f position;
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
        auto steps = static_cast<std::int64_t>(packed >> (21 * axis) & 0x1fffff);
        if (steps >= 1 << 20) steps -= 1 << 21;
        position[axis] = static_cast<float>(steps) * step;
    }
    return position;
}

Quatf unpack_rotation(std::uint64_t packed, int bits) {
    const auto top = static_cast<float>((1 << bits) - 1);
    const auto largest = static_cast<std::size_t>(packed >> (3 * bits));
    std::array<float, 4> parts{};
    float rest = 1.0F;
    for (std::size_t i = 0; i < 4; ++i) {
        if (i == largest) continue;
        parts[i] =
            (static_cast<float>(packed & ((1U << bits) - 1U)) / top - 0.5F) * std::numbers::sqrt2_v<float>;
        rest -= parts[i] * parts[i];
        packed >>= bits;
    }
    parts.at(largest) = std::sqrt(std::max(rest, 0.0F));
    return {parts[3], parts[0], parts[1], parts[2]};
}

Quatf random_rotation(std::mt19937& random) {
    std::normal_distribution<float> part;
    return Quatf(part(random), part(random), part(random), part(random)).normalized();
}

TEST(Rotation, IsOffByLittle) {
    std::mt19937 random(1);
    for (const auto& [bits, limit] :
         {std::pair{player_rotation_bits, 0.005F}, std::pair{camera_rotation_bits, 2e-4F}})
        for (int i = 0; i < 10'000; ++i) {
            const Quatf rotation = random_rotation(random);
            const Quatf back = unpack_rotation(pack_rotation(rotation, bits), bits);
            EXPECT_LT(rotation.toRotationMatrix().col(0).cross(back.toRotationMatrix().col(0)).norm(), limit);
            EXPECT_LT(rotation.toRotationMatrix().col(2).cross(back.toRotationMatrix().col(2)).norm(), limit);
        }
}

TEST(Rotation, OfBothSignsIsOne) {
    const Quatf rotation = Quatf(-0.5F, 0.5F, 0.5F, -0.5F);
    const Quatf other = Quatf(0.5F, -0.5F, -0.5F, 0.5F);
    EXPECT_EQ(pack_rotation(rotation, 15), pack_rotation(other, 15));
}

TEST(Position, IsOffByHalfAStep) {
    const float step = position_step(0.0254F);
    EXPECT_NEAR(step * 0.0254F, 0.002F, 1e-7F);
    std::mt19937 random(2);
    std::uniform_real_distribution<float> coordinate(-16384.0F, 16384.0F);
    for (int i = 0; i < 10'000; ++i) {
        const Vec3f position(coordinate(random), coordinate(random), coordinate(random));
        const Vec3f back = unpack_position(pack_position(position, step), step);
        EXPECT_LE((position - back).cwiseAbs().maxCoeff(), step * 0.5F + 2e-3F) << position.transpose();
    }
}

TEST(Position, IsClamped) {
    const Vec3f back = unpack_position(pack_position({1e30F, -1e30F, 0.0F}, 1.0F), 1.0F);
    EXPECT_EQ(back, Vec3f(1048575.0F, -1048575.0F, 0.0F));
}

TEST(Position, HasAStepWhereTheUnitIsUnknown) {
    EXPECT_EQ(position_step(0.0F), 1.0F / 12.0F);
    EXPECT_EQ(position_step(-1.0F), 1.0F / 12.0F);
}

std::string frame_of(int players, std::size_t mover_count = 0) {
    director::PoseFrame poses{1, 7, 1'500'000'000, 1'700'000'000'123'456'789, {}};
    for (int i = 0; i < players; ++i) {
        director::PlayerPose pose;
        pose.player_id = static_cast<std::uint32_t>(10 * i);
        pose.eye = Vec3f(12.5F, -3.25F, 1024.0F);
        pose.orientation = Quatf(Eigen::AngleAxisf(0.5F, Vec3f::UnitZ()));
        pose.flags = 1;
        poses.poses.push_back(pose);
    }
    director::CameraFrame cameras{1, 9, 7, poses.frame_time, poses.source_time, {}, {}};
    director::ShotCamera camera;
    camera.camera_id = 4'000'000'000U;
    camera.target = 10;
    camera.position = Vec3f(-100.0F, 0.0F, 50.0F);
    camera.orientation = Quatf(Eigen::AngleAxisf(-1.25F, Vec3f::UnitZ()));
    camera.vertical_fov = 1.0F;
    camera.flags = 3;
    cameras.cameras = {camera};
    const std::array<director::MoverPose, 2> movers = {
        director::MoverPose{3},
        {4'294'967'295U, Vec3f(8.0F, -0.5F, 96.25F), Quatf(Eigen::AngleAxisf(0.75F, Vec3f::UnitZ()))}};
    return encode_frame(poses, cameras, std::span(movers).first(mover_count), 0.25F,
                        [](std::uint32_t player) {
                            return player == 990 ? no_slot : static_cast<std::uint8_t>(player / 10);
                        });
}

std::string hex_of(const std::string& bytes) {
    static constexpr const char* digits = "0123456789abcdef";
    std::string hex;
    for (const char byte : bytes) {
        hex += digits[static_cast<unsigned char>(byte) >> 4U];
        hex += digits[static_cast<unsigned char>(byte) & 15U];
    }
    return hex;
}

// The same bytes are decoded by the page's tests.
TEST(Frame, IsTheGoldenOne) {
    std::ifstream file(CAMDIR_GOLDEN_FRAME);
    std::string golden;
    ASSERT_TRUE(file >> golden) << CAMDIR_GOLDEN_FRAME;
    EXPECT_EQ(hex_of(frame_of(2, 2)), golden);
}

TEST(Frame, LeavesOutPlayersWithoutASlot) {
    EXPECT_EQ(frame_of(100).size(), frame_of(99).size());
}

TEST(Frame, Of32PlayersTakes30KilobytesASecond) {
    EXPECT_LE(60 * frame_of(32).size(), 30'000U);
}

}  // namespace
}  // namespace camdir::live
