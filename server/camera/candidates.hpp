// Where the player could be seen from: directions from the eye, how far they are free, and the choice among
// them over the plan.
#pragma once

#include <array>
#include <optional>

#include "camera/plan.hpp"
#include "camera/profile.hpp"
#include "camera/programme.hpp"
#include "freespace/freespace.hpp"

namespace camdir::camera {

// Where a beam from the player's eye ends before its goal.
struct BeamEnd {
    float free_length;
    Vec3f normal;  // roughly of the obstacle: the way out of the last free ball, length 1
};

// Beams from the eyes of a future. Their radius is 4/3 of the clearance that the camera keeps, but less than
// the eye's own clearance.
class Beams {
  public:
    Beams(const freespace::Freespace& freespace, const MapProfile& profile, const Future& future)
        : freespace_(freespace), profile_(profile), future_(future) {
        radius_.fill(-1.0F);
    }

    // How far the beam from the eye of sample i is free in a direction (unit), at most `length`.
    [[nodiscard]] float free_length(std::size_t i, const Vec3f& direction, float length);
    // None when the beam is free for `length`.
    [[nodiscard]] std::optional<BeamEnd> end(std::size_t i, const Vec3f& direction, float length);

  private:
    float radius(std::size_t i);

    const freespace::Freespace& freespace_;
    const MapProfile& profile_;
    const Future& future_;
    std::array<float, Future::capacity> radius_;  // negative: not asked yet
};

struct CandidateScratch {
    Programme programme;
    std::array<Programme::DirectionCosts, Programme::knots> direction_costs;
};

// Chooses a direction and a length for each knot of the plan, and sets goals and lengths of all samples from
// them. Straight behind is preferred to a direction of the grid beside it.
void choose_directions(const MapProfile& profile, const History& history, Beams& beams, Plan& plan,
                       CandidateScratch& scratch);

}  // namespace camdir::camera
