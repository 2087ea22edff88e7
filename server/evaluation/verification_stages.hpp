// What verify() consists of, one file each.
#pragma once

#include "evaluation/verification.hpp"
#include "oracle/reachability.hpp"

namespace camdir::evaluation {

struct VerificationJob {
    const freespace::Freespace& freespace;
    const scene::Scene& scene;
    const oracle::Oracle& oracle;
    const oracle::Reachability& reachability;
    double tolerance;  // map units
    const VerificationParameters& parameters;
    const VerificationProgress& progress;
    const std::stop_token& stop;
};

// How far an exploration is, as a stage of the verification. `progress` must outlive the result.
[[nodiscard]] inline oracle::ExploreProgress explore_progress(const VerificationProgress& progress) {
    return [&progress](std::uint64_t cells) { progress("cells explored", cells, 0); };
}

// Draws points uniformly in the reachable free volume: coverage, tightness and overestimates of the result.
// Fails when no spawn point lies in free space, and as oracle::ReachedGrid::explore.
[[nodiscard]] Result<void> verify_coverage(const VerificationJob& job, Verification& result);

// Draws half of the balls uniformly by area and half uniformly by triangle, and takes every vertex and edge
// midpoint: by_area, by_triangle, at_vertices and at_edges of the result. Fails only with
// ErrorCode::interrupted.
[[nodiscard]] Result<void> verify_balls(const VerificationJob& job, Verification& result);

}  // namespace camdir::evaluation
