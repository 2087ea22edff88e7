#include "walk.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "freespace/distance.hpp"
#include "freespace/visibility.hpp"

namespace camdir::camera {
namespace {

constexpr float run_speed = 320.0F;
constexpr float turn_speed = 2.0F * std::numbers::pi_v<float>;
constexpr float gravity = 800.0F;
constexpr float jump_speed = 270.0F;
constexpr float body = 15.0F;

}  // namespace

Pose pose_at(const Vec3f& eye, float yaw, float pitch) {
    Pose pose;
    pose.eye = eye;
    pose.orientation = orientation_of({yaw, pitch});
    return pose;
}

Profile solved_by(Solver solver) {
    Profile profile;
    profile.solver = solver;
    return profile;
}

const char* name_of(Solver solver) {
    return solver == Solver::planner ? "planner" : "paper";
}

Runner::Runner(const test::Plan& plan, const Vec3f& eye, std::uint32_t seed)
    : plan_(plan), random_(seed), eye_(eye), ground_(eye.z()) {}

Pose Runner::next(float dt) {
    std::uniform_real_distribution<float> share(0.0F, 1.0F);
    if (share(random_) < 1.5F * dt) wanted_yaw_ = wrapped(2.0F * std::numbers::pi_v<float> * share(random_));
    if (share(random_) < 1.0F * dt) pitch_ = share(random_) - 0.5F;
    if (eye_.z() <= ground_ && share(random_) < 0.5F * dt) rise_ = jump_speed;
    const float turn = std::clamp(wrapped(wanted_yaw_ - yaw_), -turn_speed * dt, turn_speed * dt);
    yaw_ = wrapped(yaw_ + turn);

    rise_ -= gravity * dt;
    Vec3f next = eye_ + run_speed * dt * Vec3f(std::cos(yaw_), std::sin(yaw_), 0.0F);
    next.z() = std::max(ground_, eye_.z() + rise_ * dt);
    if (next.z() <= ground_) rise_ = 0.0F;
    if (plan_.clearance(next) < body) {
        next.head<2>() = eye_.head<2>();
        wanted_yaw_ = wrapped(2.0F * std::numbers::pi_v<float> * share(random_));
    }
    Pose pose = pose_at(next, yaw_, pitch_);
    pose.velocity = (next - eye_) / dt;
    eye_ = next;
    return pose;
}

CheckedShot::CheckedShot(const test::Plan& plan, const Profile& profile)
    : plan_(plan), freespace_(plan.freespace()), profile_(profile), scratch_(freespace_) {}

Camera CheckedShot::step(const Pose* pose, double dt) {
    const Camera camera = camera::step(freespace_, profile_, pose, dt, state_, scratch_);
    check(camera, pose);
    position_ = camera.position;
    placed_ = true;
    cuts_ += (camera.flags & cut) != 0 ? 1 : 0;
    return camera;
}

void CheckedShot::check(const Camera& camera, const Pose* pose) {
    ASSERT_TRUE(camera.position.allFinite());
    ASSERT_TRUE(camera.orientation.coeffs().allFinite());
    const ObjectiveTerms& c = camera.objective;
    for (const float term : {c.visibility, c.distance, c.angle, c.inertia_distance, c.inertia_angle, c.safety,
                             c.total, camera.clearance, camera.vertical_fov}) {
        ASSERT_TRUE(std::isfinite(term));
    }
    EXPECT_NEAR(camera.orientation.norm(), 1.0F, 1e-4F);
    EXPECT_NEAR((camera.orientation * Vec3f::UnitY()).z(), 0.0F, 1e-4F) << "the horizon is level";
    EXPECT_GT((camera.orientation * Vec3f::UnitZ()).z(), -1e-4F) << "not upside down";

    EXPECT_GT(camera.clearance, 0.0F);
    EXPECT_LE(camera.clearance, plan_.clearance(camera.position) + 1e-3F);
    if (placed_ && (camera.flags & cut) == 0 && camera.position != position_) {
        EXPECT_TRUE(freespace::sight(freespace_, position_, camera.position).clear);
        EXPECT_TRUE(plan_.segment_clear(position_, camera.position));
        EXPECT_LE((camera.position - position_).norm(), profile_.step_limit * 1.001F);
    }
    if ((camera.flags & target_visible) != 0) {
        ASSERT_NE(pose, nullptr);
        EXPECT_TRUE(plan_.segment_clear(camera.position, pose->eye));
    }
}

}  // namespace camdir::camera
