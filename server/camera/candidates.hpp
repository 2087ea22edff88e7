// Where the player could be seen from: directions from the eye, how far they are free, and the choice among
// them over the plan.
#pragma once

#include <array>

#include "camera/beams.hpp"
#include "camera/plan.hpp"
#include "camera/profile.hpp"
#include "camera/programme.hpp"

namespace camdir::camera {

struct CandidateScratch {
    Programme programme;
    std::array<DirectionCosts, Programme::knots> direction_costs;
};

// Chooses a direction and a length for each knot of the plan, and sets goals and lengths of all samples from
// them. Straight behind is preferred to a direction of the grid beside it.
void choose_directions(const MapProfile& profile, const History& history, Beams& beams, Plan& plan,
                       CandidateScratch& scratch);

}  // namespace camdir::camera
