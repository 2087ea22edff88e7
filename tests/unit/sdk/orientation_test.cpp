// Orientations from the view angles of Quake and its descendants.
#include <camera_director/camera_director.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <limits>
#include <numbers>
#include <random>

namespace camdir::sdk {
namespace {

constexpr double radian = std::numbers::pi / 180.0;

TEST(Orientation, IsYawThenPitchThenRoll) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> degrees(-720.0F, 720.0F);
    for (int i = 0; i < 1000; ++i) {
        const float angles[3] = {degrees(random), degrees(random), degrees(random)};
        float q[4];
        ASSERT_EQ(cdir_orientation_from_angles(angles, q), CDIR_OK);
        const Eigen::Quaterniond expected = Eigen::AngleAxisd(angles[1] * radian, Eigen::Vector3d::UnitZ()) *
                                            Eigen::AngleAxisd(angles[0] * radian, Eigen::Vector3d::UnitY()) *
                                            Eigen::AngleAxisd(angles[2] * radian, Eigen::Vector3d::UnitX());
        const Eigen::Quaterniond found(q[3], q[0], q[1], q[2]);
        EXPECT_NEAR(found.norm(), 1.0, 1e-6);
        EXPECT_LT(found.angularDistance(expected), 1e-3);
    }
}

// Positive pitch looks down.
TEST(Orientation, PitchOf90LooksDown) {
    const float angles[3] = {90.0F, 45.0F, 0.0F};
    float q[4];
    ASSERT_EQ(cdir_orientation_from_angles(angles, q), CDIR_OK);
    const Eigen::Vector3f forward = Eigen::Quaternionf(q[3], q[0], q[1], q[2]) * Eigen::Vector3f::UnitX();
    EXPECT_NEAR(forward.z(), -1.0F, 1e-6F);
}

TEST(Orientation, RefusesAnglesThatAreNotFiniteAndNullPointers) {
    std::array<float, 4> q{7.0F, 7.0F, 7.0F, 7.0F};
    const std::array<float, 3> angles{}, bad{0.0F, std::numeric_limits<float>::quiet_NaN(), 0.0F};
    EXPECT_EQ(cdir_orientation_from_angles(bad.data(), q.data()), CDIR_INVALID_ARGUMENT);
    EXPECT_EQ(cdir_orientation_from_angles(nullptr, q.data()), CDIR_INVALID_ARGUMENT);
    EXPECT_EQ(cdir_orientation_from_angles(angles.data(), nullptr), CDIR_INVALID_ARGUMENT);
    EXPECT_EQ(q[0], 7.0F);
}

}  // namespace
}  // namespace camdir::sdk
