// How much of the reachable free space a VFS-rep knows, and how well.
#pragma once

#include "evaluation/verification.hpp"

namespace camdir::evaluation {

// Draws points uniformly in the reachable free volume: coverage, tightness and overestimates of the result.
// Fails when no spawn point lies in free space.
[[nodiscard]] Result<void> verify_coverage(const freespace::Freespace& freespace, const scene::Scene& scene,
                                           const oracle::Oracle& oracle, double tolerance,
                                           const VerificationParameters& parameters,
                                           const VerificationProgress& progress, const std::stop_token& stop,
                                           Verification& result);

}  // namespace camdir::evaluation
