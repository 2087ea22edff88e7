#include "camera/guard.hpp"

#include <algorithm>
#include <array>

#include "camera/regain.hpp"

namespace camdir::camera {
namespace {

constexpr std::array pulled_in = {1.0F, 0.9F, 0.75F};  // shares of the free line of sight

}  // namespace

std::optional<Candidate> guarded(const freespace::Space& space, const MapProfile& profile,
                                 const PlayerTrack& track, const Motion& motion, const Vec3f& wanted,
                                 freespace::RecentBalls& recent) {
    const auto fine = [&](const Vec3f& target) {
        auto place = reach(space, profile, track, motion.position,
                           within_step(motion.position, target, profile.step_limit), &recent);
        if (place && !acceptable(profile, track, *place)) place.reset();
        return place;
    };
    if (auto place = fine(wanted)) return place;
    const Vec3f arm = wanted - track.anchor;
    const float length = arm.norm();
    if (length > profile.unit) {
        const freespace::Sight beam =
            freespace::sight(space, track.anchor, wanted, beam_radius(profile, track));
        const float free =
            beam.clear ? length : std::max(0.0F, beam.free_length - inside_beam * profile.unit);
        for (const float share : pulled_in) {
            if (auto place = fine(track.anchor + arm * (share * free / length))) return place;
        }
    }
    return regain_sight(space, profile, track, motion, wanted);
}

}  // namespace camdir::camera
