#include "camera/objective.hpp"

#include <algorithm>
#include <cmath>

#include "camera/view.hpp"

namespace camdir::camera {
namespace {

constexpr float unseen = 1e6F;  // c_vis of a player who is not seen: finite, and worse than any other cost
constexpr float least_clearance = 0.01F;  // units: what c_safe divides by at least

// 1/gamma of the paper, with the smallest clearance along the line of sight for gamma, in shares of what a
// camera keeps anyway: 1 for a sight line as free as that or freer.
float visibility(const MapProfile& profile, float sight_clearance) {
    if (sight_clearance <= 0.0F) return unseen;
    const float wanted = std::max(profile.minimum_clearance, profile.visibility_threshold);
    return std::pow(std::max(1.0F, wanted / sight_clearance), profile.weight_visibility);
}

}  // namespace

ObjectiveTerms objective(const MapProfile& profile, const PlayerTrack& track, const Motion& motion,
                         const Candidate& candidate) {
    const Vec3f line_of_sight = track.anchor - candidate.position;
    const Vec3f velocity = (candidate.position - motion.position) / motion.dt;
    const float speed = velocity.norm();
    const float speed_before = motion.velocity.norm();
    // An angle between motions means the more, the faster they are: as the chord that it makes.
    const float turn = angle_between(velocity, motion.velocity) * std::sqrt(speed * speed_before);

    ObjectiveTerms terms;
    terms.visibility = visibility(profile, candidate.sight_clearance);
    terms.distance = profile.weight_distance *
                     squared((line_of_sight.norm() - profile.distance) / profile.distance_tolerance);
    terms.angle =
        profile.weight_angle * squared(angle_between(line_of_sight, track.heading) / profile.angle_tolerance);
    terms.inertia_distance =
        profile.weight_inertia_distance * squared((speed - speed_before) / profile.speed_tolerance);
    terms.inertia_angle = profile.weight_inertia_angle * squared(turn / profile.speed_tolerance);
    terms.safety = profile.weight_safety * (speed / profile.safe_speed) * profile.minimum_clearance /
                   std::max(candidate.clearance, least_clearance * profile.unit);
    terms.total = terms.visibility * (terms.distance + terms.angle + terms.inertia_distance +
                                      terms.inertia_angle + terms.safety);
    return terms;
}

}  // namespace camdir::camera
