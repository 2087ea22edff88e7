// The axes and units of game engines, and the view angles of Quake and its descendants.
#include <camera_director/camera_director.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

namespace camdir::sdk {
namespace {

using Eigen::Vector3f;

constexpr double radian = std::numbers::pi / 180.0;

struct Engine {
    std::uint32_t number;
    float metres;
    Vector3f forward, left, up;  // in its axes
    float handedness;
};

const std::array<Engine, 3> engines{{
    {CDIR_ENGINE_QUAKE, 0.0254F, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, 1.0F},
    {CDIR_ENGINE_UNITY, 1.0F, {0, 0, 1}, {-1, 0, 0}, {0, 1, 0}, -1.0F},
    {CDIR_ENGINE_UNREAL, 0.01F, {1, 0, 0}, {0, -1, 0}, {0, 0, 1}, -1.0F},
}};

Vector3f here(const Engine& engine, const Vector3f& there, float metres_per_unit) {
    Vector3f converted = there;  // in place
    EXPECT_EQ(cdir_position_from_engine(engine.number, metres_per_unit, converted.data(), converted.data()),
              CDIR_OK)
        << cdir_last_error();
    return converted;
}

Vector3f there(const Engine& engine, const Vector3f& here, float metres_per_unit) {
    Vector3f converted;
    EXPECT_EQ(cdir_position_to_engine(engine.number, metres_per_unit, here.data(), converted.data()), CDIR_OK)
        << cdir_last_error();
    return converted;
}

Eigen::Quaternionf here(const Engine& engine, const Eigen::Quaternionf& there) {
    Eigen::Quaternionf converted = there;
    EXPECT_EQ(
        cdir_orientation_from_engine(engine.number, converted.coeffs().data(), converted.coeffs().data()),
        CDIR_OK)
        << cdir_last_error();
    return converted;
}

Eigen::Quaternionf there(const Engine& engine, const Eigen::Quaternionf& here) {
    Eigen::Quaternionf converted;
    EXPECT_EQ(cdir_orientation_to_engine(engine.number, here.coeffs().data(), converted.coeffs().data()),
              CDIR_OK)
        << cdir_last_error();
    return converted;
}

class Conversions : public testing::Test {
  protected:
    float number(float most) { return std::uniform_real_distribution<float>(-most, most)(random_); }
    Vector3f vector() { return {number(1e4F), number(1e4F), number(1e4F)}; }
    Eigen::Quaternionf turn() {
        return Eigen::Quaternionf(number(1), number(1), number(1), number(1)).normalized();
    }

    std::mt19937 random_{3};
};

TEST_F(Conversions, AxesAreForwardLeftAndUpHere) {
    for (const Engine& engine : engines) {
        EXPECT_EQ(here(engine, engine.forward, engine.metres), Vector3f(1, 0, 0)) << engine.number;
        EXPECT_EQ(here(engine, engine.left, engine.metres), Vector3f(0, 1, 0)) << engine.number;
        EXPECT_EQ(here(engine, engine.up, engine.metres), Vector3f(0, 0, 1)) << engine.number;
        const float volume = here(engine, Vector3f::UnitX(), engine.metres)
                                 .cross(here(engine, Vector3f::UnitY(), engine.metres))
                                 .dot(here(engine, Vector3f::UnitZ(), engine.metres));
        EXPECT_EQ(volume, engine.handedness) << engine.number;
    }
}

TEST_F(Conversions, LengthsAreInTheMapsUnits) {
    // One metre in units of 0.0254 m; a map of 1 m in units of 0.01 m.
    EXPECT_FLOAT_EQ(here(engines[1], {0, 0, 1}, 0.0254F).x(), 39.370079F);
    EXPECT_FLOAT_EQ(here(engines[2], {250, 0, 0}, 1.0F).x(), 2.5F);
    EXPECT_FLOAT_EQ(there(engines[2], {2.5F, 0, 0}, 1.0F).x(), 250.0F);
    EXPECT_FLOAT_EQ(there(engines[0], {0, 1, 0}, 1.0F).y(), 39.370079F);
}

TEST_F(Conversions, ThereAndBackIsTheSame) {
    for (const Engine& engine : engines) {
        for (int i = 0; i < 1000; ++i) {
            const Vector3f v = vector();
            EXPECT_EQ(there(engine, here(engine, v, engine.metres), engine.metres), v) << engine.number;
            const Vector3f scaled = there(engine, here(engine, v, 0.3F), 0.3F);
            EXPECT_LT((scaled - v).norm(), 1e-6F * v.norm()) << engine.number;
            const Eigen::Quaternionf q = turn();
            EXPECT_EQ(there(engine, here(engine, q)).coeffs(), q.coeffs()) << engine.number;
        }
    }
}

// Turning there and converting is converting and turning here.
TEST_F(Conversions, OrientationsTurnWhatTheyTurnInTheEngine) {
    for (const Engine& engine : engines) {
        for (int i = 0; i < 1000; ++i) {
            const Vector3f v = vector();
            const Eigen::Quaternionf q = turn();
            const Vector3f turned = here(engine, q * v, engine.metres);
            EXPECT_LT((here(engine, q) * here(engine, v, engine.metres) - turned).norm(), 2e-6F * v.norm());
        }
    }
}

// In both, a player who turns to the right by 90 degrees looks along -y here.
TEST_F(Conversions, ATurnToTheRightIsOneHere) {
    const float half = std::sqrt(0.5F);
    const Eigen::Quaternionf unity(half, 0, half, 0);   // Quaternion.Euler(0, 90, 0)
    const Eigen::Quaternionf unreal(half, 0, 0, half);  // FRotator(0, 90, 0).Quaternion()
    EXPECT_LT((here(engines[1], unity) * Vector3f::UnitX() + Vector3f::UnitY()).norm(), 1e-6F);
    EXPECT_LT((here(engines[2], unreal) * Vector3f::UnitX() + Vector3f::UnitY()).norm(), 1e-6F);
}

TEST_F(Conversions, WhatCannotBeConvertedIsRefused) {
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    std::array<float, 4> to{7, 7, 7, 7};
    const std::array<float, 3> zero{}, bad{0, nan, 0}, huge{3e38F, 0, 0};
    const std::array<float, 4> unit{0, 0, 0, 1}, bent{0, 0, 0, 1.1F};
    const auto refused = [&](cdir_status status, const char* why) {
        EXPECT_EQ(status, CDIR_INVALID_ARGUMENT);
        EXPECT_STREQ(cdir_last_error(), why);
        EXPECT_EQ(to[0], 7.0F);
    };
    refused(cdir_position_from_engine(0, 1, zero.data(), to.data()), "engine is 0, none of CDIR_ENGINE_");
    refused(cdir_position_to_engine(4, 1, zero.data(), to.data()), "engine is 4, none of CDIR_ENGINE_");
    refused(cdir_position_from_engine(2, 1, nullptr, to.data()), "position is null");
    refused(cdir_position_from_engine(2, 1, zero.data(), nullptr), "converted is null");
    refused(cdir_position_from_engine(2, 1, bad.data(), to.data()), "a position is not finite");
    for (const float wrong : {0.0F, -1.0F, nan})
        refused(cdir_position_to_engine(2, wrong, zero.data(), to.data()),
                "metres_per_unit must be greater than 0");
    refused(cdir_position_to_engine(3, 1, huge.data(), to.data()), "a converted position is out of range");
    refused(cdir_orientation_from_engine(2, bent.data(), to.data()), "an orientation is not of length 1");
    refused(cdir_orientation_to_engine(2, nullptr, to.data()), "orientation is null");
    refused(cdir_orientation_to_engine(2, unit.data(), nullptr), "converted is null");
    refused(cdir_orientation_from_angles(bad.data(), to.data()), "an angle is not finite");
    refused(cdir_orientation_from_angles(nullptr, to.data()), "angles is null");
    refused(cdir_orientation_from_angles(zero.data(), nullptr), "orientation is null");
    refused(cdir_orientation_to_angles(bent.data(), to.data()), "an orientation is not of length 1");
    refused(cdir_orientation_to_angles(nullptr, to.data()), "orientation is null");
    refused(cdir_orientation_to_angles(unit.data(), nullptr), "angles is null");
}

Eigen::Quaternionf orientation_of(const std::array<float, 3>& angles) {
    Eigen::Quaternionf q;
    EXPECT_EQ(cdir_orientation_from_angles(angles.data(), q.coeffs().data()), CDIR_OK);
    return q;
}

std::array<float, 3> angles_of(const Eigen::Quaternionf& q) {
    std::array<float, 3> angles;
    EXPECT_EQ(cdir_orientation_to_angles(q.coeffs().data(), angles.data()), CDIR_OK) << cdir_last_error();
    return angles;
}

TEST_F(Conversions, AnglesAreYawThenPitchThenRoll) {
    for (int i = 0; i < 1000; ++i) {
        const std::array<float, 3> angles{number(720), number(720), number(720)};
        const Eigen::Quaterniond expected = Eigen::AngleAxisd(angles[1] * radian, Eigen::Vector3d::UnitZ()) *
                                            Eigen::AngleAxisd(angles[0] * radian, Eigen::Vector3d::UnitY()) *
                                            Eigen::AngleAxisd(angles[2] * radian, Eigen::Vector3d::UnitX());
        const Eigen::Quaterniond found = orientation_of(angles).cast<double>();
        EXPECT_NEAR(found.norm(), 1.0, 1e-6);
        EXPECT_LT(found.angularDistance(expected), 1e-3);
    }
}

TEST_F(Conversions, APitchOf90LooksDown) {
    EXPECT_NEAR((orientation_of({90, 45, 0}) * Vector3f::UnitX()).z(), -1.0F, 1e-6F);
}

TEST_F(Conversions, AnglesOfAnOrientationAreThatOrientation) {
    const auto same = [&](const Eigen::Quaternionf& q) {
        const std::array<float, 3> angles = angles_of(q);
        EXPECT_LE(std::abs(angles[0]), 90.0F);
        EXPECT_LE(std::abs(angles[1]), 180.0F);
        EXPECT_LE(std::abs(angles[2]), 180.0F);
        EXPECT_LT(orientation_of(angles).cast<double>().angularDistance(q.cast<double>()), 1e-5)
            << angles[0] << ' ' << angles[1] << ' ' << angles[2];
    };
    for (int i = 0; i < 1000; ++i) {
        same(turn());
        for (const float pitch : {90.0F, -90.0F, 89.9999F, -89.999F}) {
            same(orientation_of({pitch, number(180), number(180)}));
        }
    }
    const std::array<float, 3> known = angles_of(orientation_of({-30, 120, 10}));
    EXPECT_NEAR(known[0], -30.0F, 1e-4F);
    EXPECT_NEAR(known[1], 120.0F, 1e-4F);
    EXPECT_NEAR(known[2], 10.0F, 1e-4F);
    EXPECT_EQ(angles_of(orientation_of({90, 45, 0}))[2], 0.0F) << "all is yaw where the view is vertical";
}

}  // namespace
}  // namespace camdir::sdk
