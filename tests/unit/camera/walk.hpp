// Players for the tracker's tests, and what a camera path promises.
#pragma once

#include <random>
#include <vector>

#include "camera/tracker.hpp"
#include "support/plan.hpp"

namespace camdir::camera {

// A pose of a living player who looks along `yaw` (radians).
[[nodiscard]] Pose pose_at(const Vec3f& eye, float yaw, float pitch = 0.0F);

// The default profile with this solver.
[[nodiscard]] Profile solved_by(Solver solver);
[[nodiscard]] const char* name_of(Solver solver);

// A player who runs through the free cells of a plan, turns as fast as bots do, jumps, and stays as far from
// the walls as a player's box.
class Runner {
  public:
    Runner(const test::Plan& plan, const Vec3f& eye, std::uint32_t seed);

    [[nodiscard]] Pose next(float dt);

  private:
    const test::Plan& plan_;
    std::mt19937 random_;
    Vec3f eye_;
    float ground_;
    float yaw_ = 0.0F;
    float wanted_yaw_ = 0.0F;
    float pitch_ = 0.0F;
    float rise_ = 0.0F;
};

// One shot on a plan; every camera is checked against the guarantees of step() as it comes: finite, a unit
// quaternion with a level horizon, in freespace, no step through anything solid that is not a declared cut,
// and true flags.
class CheckedShot {
  public:
    explicit CheckedShot(const test::Plan& plan, const Profile& profile = {});

    Camera step(const Pose* pose, double dt = 1.0 / 60.0);
    Camera step(const Pose& pose, double dt = 1.0 / 60.0) { return step(&pose, dt); }

    [[nodiscard]] const freespace::Freespace& freespace() const { return freespace_; }
    [[nodiscard]] const ShotState& state() const { return state_; }
    [[nodiscard]] int cuts() const { return cuts_; }

  private:
    void check(const Camera& camera, const Pose* pose);

    const test::Plan& plan_;
    freespace::Freespace freespace_;
    Profile profile_;
    Scratch scratch_;
    ShotState state_;
    Vec3f position_ = Vec3f::Zero();
    bool placed_ = false;
    int cuts_ = 0;
};

}  // namespace camdir::camera
