// Does a VFS-rep keep its promise on the map that it was baked from?
//
// Balls and points are drawn at random: a fault that none of them hits stays unseen. They are measured by the
// oracle, which shares no code with the baker, but against the same Scene: what the map's reader did to the
// map, such as the flat triangles in place of curved patches, no verification sees.
//
// Unsafe ball: obstacle surface lies deeper than 0.02 units of 0.0254 m inside it, or its centre lies in a
// solid or is not reachable. Coverage: share of the random points, drawn uniformly in the reachable free
// volume, that lie in a slab. Tightness: mean of reported free distance / clearance over the points with
// clearance > d0. Reachable: on a grid of pitch 8 units, joined by a free segment to a cell that the flood
// from the spawn points reaches (oracle/reached_grid.hpp), with clearance > d0 for points, > half a pitch for
// the centres of balls.
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
    std::uint64_t balls = 100'000;   // drawn at random, in addition to every vertex and edge midpoint
    std::uint64_t points = 100'000;  // of the reachable free space, for coverage and tightness
    std::uint64_t seed = 1;
};

enum class BallFault { surface_inside, centre_in_solid, centre_unreachable };
inline constexpr std::array<const char*, 3> fault_names = {"surface_inside", "centre_in_solid",
                                                           "centre_unreachable"};

struct UnsafeBall {
    Vec3d centre;
    double radius;
    double excess;  // depth of the surface in the ball, or of the centre in the solid; 0 when unreachable
};

struct BallCounts {
    std::uint64_t tested = 0;
    std::uint64_t skipped = 0;                           // radius <= 0: they claim no free space
    std::array<std::uint64_t, 3> unsafe{};               // by BallFault; a ball counts under its first one
    std::array<std::optional<UnsafeBall>, 3> deepest{};  // by BallFault; of equals the one drawn first

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
    std::uint64_t joined_spawn_points = 0;  // of those, the largest number in one component of the roadmap

    [[nodiscard]] std::uint64_t unsafe_balls() const;
    // A ball or a reported distance that reaches into an obstacle.
    [[nodiscard]] bool has_violation() const { return unsafe_balls() + overestimates > 0; }
};

// How far a stage is; `total` 0 = unknown. Called from several threads.
using VerificationProgress =
    std::function<void(std::string_view stage, std::uint64_t done, std::uint64_t total)>;

// Uses all cores; the result does not depend on how many there are. Fails with ErrorCode::interrupted soon
// after `stop` is requested; when no spawn point of the scene lies in free space; and before it allocates
// anything when the scene's bounds are too large to explore (oracle::max_grid_bytes).
[[nodiscard]] Result<Verification> verify(const freespace::Freespace& freespace, const scene::Scene& scene,
                                          const oracle::Oracle& oracle,
                                          const VerificationParameters& parameters,
                                          const VerificationProgress& progress, const std::stop_token& stop);

}  // namespace camdir::evaluation
