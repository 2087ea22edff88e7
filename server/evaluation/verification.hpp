// Does a VFS-rep keep its promise on the map that it was baked from? The definitions are those of the
// project's contracts: unsafe ball, reachable, coverage, tightness.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <stop_token>
#include <string_view>

#include "base/error.hpp"
#include "base/geometry.hpp"
#include "freespace/freespace.hpp"
#include "oracle/oracle.hpp"
#include "scene/scene.hpp"

namespace camdir::evaluation {

struct VerificationParameters {
    std::uint64_t balls = 100'000;   // drawn at random; every vertex and edge midpoint comes on top
    std::uint64_t points = 100'000;  // of the reachable free space, for coverage and tightness
    std::uint64_t seed = 1;
};

enum class Fault { surface_inside, centre_in_solid, centre_unreachable };
inline constexpr std::array<const char*, 3> fault_names = {"surface_inside", "centre_in_solid",
                                                           "centre_unreachable"};

struct UnsafeBall {
    Vec3d centre;
    double radius;
    double excess;  // how deep the surface, or how deep in solid the centre; 0 for one that is unreachable
};

struct BallCounts {
    std::uint64_t tested = 0;
    std::uint64_t skipped = 0;                           // radius <= 0: they claim no free space
    std::array<std::uint64_t, 3> unsafe{};               // by Fault; a ball counts under its first one
    std::array<std::optional<UnsafeBall>, 3> deepest{};  // by Fault; of equals the one drawn first

    [[nodiscard]] std::uint64_t unsafe_count() const { return unsafe[0] + unsafe[1] + unsafe[2]; }
};

struct Coverage {
    std::uint64_t points = 0;
    std::uint64_t covered = 0;

    [[nodiscard]] double share() const;  // NaN without points
};

struct Verification {
    BallCounts by_area, by_triangle, at_vertices, at_edges;

    // Buckets: clearance > 0, > d0, > 2 d0.
    std::array<Coverage, 3> coverage;
    double tightness = 0.0;           // over the second bucket; NaN when it is empty
    std::uint64_t overestimates = 0;  // points where the query reports more than the clearance
    double largest_overestimate = 0.0;

    std::uint64_t components = 0;  // of the roadmap
    std::uint64_t spawn_points = 0;
    std::uint64_t covered_spawn_points = 0;
    std::uint64_t joined_spawn_points = 0;  // of those the most that lie in one component of the roadmap

    [[nodiscard]] std::uint64_t unsafe_balls() const;
    // A ball or a reported distance that reaches into an obstacle.
    [[nodiscard]] bool has_violation() const { return unsafe_balls() + overestimates > 0; }
};

// How far a stage is; called from several threads.
using VerificationProgress =
    std::function<void(std::string_view stage, std::uint64_t done, std::uint64_t total)>;

// Uses all cores; the result does not depend on how many there are. Fails with ErrorCode::interrupted soon
// after `stop` is requested, and with `failed` when no spawn point of the scene lies in free space.
[[nodiscard]] Result<Verification> verify(const freespace::Freespace& freespace, const scene::Scene& scene,
                                          const oracle::Oracle& oracle,
                                          const VerificationParameters& parameters,
                                          const VerificationProgress& progress, const std::stop_token& stop);

}  // namespace camdir::evaluation
