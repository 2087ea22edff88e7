// The balls of a VFS-rep against the source.
#pragma once

#include "evaluation/verification.hpp"

namespace camdir::evaluation {

// Draws half of the balls uniformly by area and half uniformly by triangle, and takes every vertex and edge
// midpoint: the first four members of the result.
void verify_balls(const freespace::Freespace& freespace, const oracle::Oracle& oracle, double tolerance,
                  const VerificationParameters& parameters, const VerificationProgress& progress,
                  const std::stop_token& stop, Verification& result);

}  // namespace camdir::evaluation
