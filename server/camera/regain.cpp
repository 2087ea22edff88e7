#include "camera/regain.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "camera/evade.hpp"

namespace camdir::camera {
namespace {

constexpr std::array swings = {0.0F,
                               -3.0F * radians_of_a_degree<float>,
                               3.0F * radians_of_a_degree<float>,
                               -7.0F * radians_of_a_degree<float>,
                               7.0F * radians_of_a_degree<float>,
                               -14.0F * radians_of_a_degree<float>,
                               14.0F * radians_of_a_degree<float>,
                               -25.0F * radians_of_a_degree<float>,
                               25.0F * radians_of_a_degree<float>};
constexpr std::array retreats = {0.1F, 0.25F, 0.5F, 0.75F, 1.0F};

// The least costly candidate so far. One with kept_clearance() beats any without; where movers leave that to
// none, more room does.
class Choice {
  public:
    Choice(const freespace::Space& space, const MapProfile& profile, const PlayerTrack& track,
           const Motion& motion)
        : has_movers_(space.has_movers()), profile_(profile), track_(track), motion_(motion) {}

    void consider(const std::optional<Candidate>& candidate) {
        if (!candidate || !is_seen(*candidate)) return;
        const bool roomy = candidate->room >= kept_clearance(profile_, track_);
        const float cost = objective(profile_, track_, motion_, *candidate).total;
        if (found_ && !is_better(*candidate, roomy, cost)) return;
        found_ = true;
        best_ = *candidate;
        roomy_ = roomy;
        cost_ = cost;
    }
    [[nodiscard]] std::optional<Candidate> best() const {
        return found_ ? std::optional<Candidate>(best_) : std::nullopt;
    }

  private:
    [[nodiscard]] bool is_better(const Candidate& candidate, bool roomy, float cost) const {
        if (roomy != roomy_) return roomy;
        if (has_movers_ && !roomy && candidate.room != best_.room) return candidate.room > best_.room;
        return cost < cost_;
    }

    bool has_movers_;
    const MapProfile& profile_;
    const PlayerTrack& track_;
    const Motion& motion_;
    bool found_ = false;
    Candidate best_;
    bool roomy_ = false;
    float cost_ = 0.0F;
};

// `wanted` swung round the anchor by `angle` and pulled in to where the beam from the anchor is free.
Vec3f swung(const freespace::Space& space, const MapProfile& profile, const PlayerTrack& track,
            const Vec3f& wanted, float angle) {
    const Vec3f arm = Eigen::AngleAxisf(angle, Vec3f::UnitZ()) * (wanted - track.anchor);
    const freespace::Sight beam =
        freespace::sight(space, track.anchor, track.anchor + arm, beam_radius(profile, track));
    if (beam.clear) return track.anchor + arm;
    return track.anchor + std::max(0.0F, beam.free_length - inside_beam * profile.unit) * arm.normalized();
}

}  // namespace

bool is_seen(const Candidate& candidate) {
    return candidate.sight_clearance > 0.0F;
}

bool acceptable(const MapProfile& profile, const PlayerTrack& track, const Candidate& candidate) {
    return is_seen(candidate) && candidate.room >= kept_clearance(profile, track);
}

std::optional<Candidate> regain_sight(const freespace::Space& space, const MapProfile& profile,
                                      const PlayerTrack& track, const Motion& motion, const Vec3f& wanted) {
    Choice choice(space, profile, track, motion);
    const auto consider = [&](const Vec3f& target) {
        const Vec3f place = within_step(motion.position, target, profile.step_limit);
        choice.consider(reach_shortened(space, profile, track, motion.position, place));
    };
    choice.consider(reach(space, profile, track, motion.position, motion.position));
    const float kept = kept_clearance(profile, track);
    if (is_threatened(space, motion.position, kept))
        if (const auto place = evade(space, motion.position, kept, profile.step_limit)) consider(*place);
    consider(motion.position + track.move);
    for (const float angle : swings) {
        consider(swung(space, profile, track, wanted, angle));
    }
    const Vec3f old_line_of_sight = track.anchor - track.move - motion.position;
    for (const float share : retreats) {
        consider(motion.position + share * old_line_of_sight);
    }
    return choice.best();
}

Vec3f within_step(const Vec3f& start, const Vec3f& target, float limit) {
    const Vec3f move = target - start;
    const float length = move.norm();
    return length > limit ? Vec3f(start + move * (limit / length)) : target;
}

}  // namespace camdir::camera
