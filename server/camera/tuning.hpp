// Temporary: the planner's constants while they are tuned.
#pragma once
#include <atomic>
namespace camdir::camera {
struct Tuning {
    float horizon = 0.4F;        // predicted, s
    float velocity_span = 0.048F, turn_span = 0.016F;
    float run_persistence = 0.5F, fall_persistence = 0.15F, turn_persistence = 0.1F, turn_end = 0.02F, turn_begin = 0.13F, most_turn = 2.0F;
    float wall = 16.0F;
    float heading_tau = 0.06F, heading_tau_ahead = 0.12F, pitch_tau = 0.12F, eye_tau = 0.03F, eye_tau_ahead = 0.05F;
    float dead_zone = 17.5F;  // degrees
    int reweightings = 3, reweightings_causal = 0, look_rounds = 0, radial_rounds = 3;
    float knot = 0.15F, knot_ahead = 0.1F;
    float cone = 75.0F;
    float beam = 6.0F;
    float wang = 1.5F, wang_ahead = 2.0F, wd = 6.0F, lam = 0.2F, lam_ahead = 0.3F, mu = 0.1F, mu_ahead = 0.5F;
    float close_cost = 3.0F;
    float snap_angle = 13.0F, snap_length = 8.0F;
    float pos_tau = 0.09F, pos_tau_ahead = 0.09F;
    int rounds = 4, rounds_ahead = 5;
    int stride = 1, reach = 0;
    float guard_velocity = 1.0F;
    float boost = 8.0F, boost_limit = 512.0F;
    float look_tau = 0.06F, look_tau_ahead = 0.08F;
    int replan = 1, replan_ahead = 6;
    int directions_every = 4;
    float extend = 0.4F;  // prediction beyond the known, s
    float hinge_angle = 48.0F, hinge_dist = 35.0F, hinge_boost = 0.0F;
    float good_weight = 1.0F, good_angle = 50.0F;
    float look_dead = 6.0F;
    float acc_tau = 0.0F;
    float x1 = 0.1F, x2 = 0, x3 = 4.0F, x4 = 0;
};
inline Tuning tuning;
inline std::atomic<long> guard_count{0}, bad_target{0}, bad_heading{0}, bad_path{0}, all_path{0};
}  // namespace camdir::camera
