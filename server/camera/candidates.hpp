// Where the player could be seen from: directions from the eye, how far they are free, and the choice among
// them over the plan.
#pragma once

#include <array>

#include "camera/beams.hpp"
#include "camera/crowd.hpp"
#include "camera/plan.hpp"
#include "camera/profile.hpp"
#include "camera/programme.hpp"

namespace camdir::camera {

struct CandidateScratch {
    Programme programme;
    std::array<DirectionCosts, Programme::knots> direction_costs;
};

// From where the player is seen at a knot of a plan.
struct Vantage {
    Look off_behind;  // from straight behind, wherever that turns
    float length = 0.0F;
    Vec3f foreseen = Vec3f::Zero();  // its direction, when it was chosen
};

// The vantages of a plan; after the last one, that one. A value.
struct Vantages {
    std::array<Vantage, Programme::knots> at_knots;
    std::size_t count = 0;         // 0: every path turns faster than the programme can, or none was chosen
    std::size_t knot_spacing = 0;  // of the plan that they were chosen for
    std::size_t age = 0;           // samples from the one at which they were chosen to the plan's first one
};

// Chooses a vantage for each knot of the plan, unless those of the last plan were chosen for the same knots
// of a prediction a moment ago and the player turns as foreseen. Straight behind is preferred to a direction
// of the grid beside it.
void choose_vantages(const MapProfile& profile, const History& history, Beams& beams, const Crowd& crowd,
                     const Plan& plan, CandidateScratch& scratch, Vantages& vantages);

// Sets goals and lengths of all samples: between the vantages; straight behind where there are none.
void set_goals(const MapProfile& profile, const Vantages& vantages, Beams& beams, Plan& plan);

}  // namespace camdir::camera
