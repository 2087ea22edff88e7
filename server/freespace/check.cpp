#include "freespace/check.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace camdir::freespace {
namespace {

std::string at(const char* what, std::size_t index, const char* flaw) {
    return std::string(what) + " " + std::to_string(index) + " " + flaw;
}

// False for NaN and infinity too.
bool within_limit(float value) {
    return std::abs(value) <= coordinate_limit;
}

bool within_limit(const Vec3f& point) {
    return within_limit(point.x()) && within_limit(point.y()) && within_limit(point.z());
}

std::string flaw_of_vertices(std::span<const Vertex> vertices) {
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const Vertex& v = vertices[i];
        const bool sane =
            within_limit(v.x) && within_limit(v.y) && within_limit(v.z) && within_limit(v.free_distance);
        if (!sane) return at("vertex", i, "is not finite or out of range");
    }
    return {};
}

std::string flaw_of_triangles(std::span<const Triangle> triangles, std::size_t vertex_count) {
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        const auto [a, b, c] = triangles[i];
        if (a >= vertex_count || b >= vertex_count || c >= vertex_count)
            return at("triangle", i, "has a corner that does not exist");
        if (a == b || b == c || c == a) return at("triangle", i, "has a corner twice");
    }
    return {};
}

constexpr float full_turn = 2.0F * std::numbers::pi_v<float>;
constexpr float quarter_turn = 0.5F * std::numbers::pi_v<float>;

// Of the rounding of single-precision normals, and no more.
constexpr float normal_tolerance = 1e-4F;

const char* flaw_of_hull(const ConvexHull& hull) {
    if (hull.half_spaces.size() < 4 || hull.half_spaces.size() > max_half_spaces)
        return "has a hull with too few or too many half spaces";
    for (const auto& [normal, distance] : hull.half_spaces)
        if (!(std::abs(normal.norm() - 1.0F) <= normal_tolerance) || !within_limit(distance))
            return "has a half space whose normal has not length 1 or whose distance is out of range";
    if (!within_limit(hull.bounds.min()) || !within_limit(hull.bounds.max()) || hull.bounds.isEmpty())
        return "has a hull whose bounds are empty, not finite or out of range";
    return nullptr;
}

// Null: none.
const char* flaw_of_mover(const MoverShape& mover) {
    if (mover.name.empty() || mover.name.size() > max_mover_name || mover.kind.size() > max_mover_name)
        return "has no name, or a name or a kind that is too long";
    if (mover.hulls.size() > max_hulls || mover.balls.size() > max_hulls)
        return "has too many hulls or balls";
    if (mover.hulls.empty() && mover.balls.empty()) return "has no hull and no ball";
    if (!within_limit(mover.rest)) return "rests at a position that is not finite or out of range";
    for (const ConvexHull& hull : mover.hulls)
        if (const char* const flaw = flaw_of_hull(hull)) return flaw;
    for (const auto& [centre, radius] : mover.balls)
        if (!within_limit(centre) || !(radius > 0.0F) || !within_limit(radius))
            return "has a ball that is not finite, out of range or without a radius";
    return nullptr;
}

}  // namespace

std::string find_metadata_flaw(const Metadata& metadata, std::span<const SpawnPoint> spawn_points) {
    const auto positive = [](float value) { return value > 0.0F && std::isfinite(value); };
    if (!positive(metadata.metres_per_unit)) return "metres_per_unit is not a positive number";
    if (!positive(metadata.d0)) return "d0 is not a positive number";
    if (!within_limit(metadata.d0)) return "d0 is out of range";
    if (metadata.counts.size() >= count_limit) return "the report has too many counts";
    for (std::size_t i = 0; i < spawn_points.size(); ++i)
        if (!spawn_points[i].eye.allFinite() || !std::isfinite(spawn_points[i].yaw))
            return at("spawn point", i, "is not finite");
    return {};
}

std::string find_movers_flaw(std::span<const MoverShape> movers) {
    if (movers.size() > max_movers) return "there are too many movers";
    for (std::size_t i = 0; i < movers.size(); ++i) {
        if (const char* const flaw = flaw_of_mover(movers[i])) return at("mover", i, flaw);
        const auto before = movers.first(i);
        if (std::any_of(before.begin(), before.end(),
                        [&](const MoverShape& other) { return other.name == movers[i].name; }))
            return at("mover", i, "has the name of another");
    }
    return {};
}

std::string find_fixed_shots_flaw(std::span<const FixedShot> shots, std::size_t spawn_point_count) {
    if (shots.size() > max_fixed_shots) return "there are too many fixed shots";
    for (std::size_t i = 0; i < shots.size(); ++i) {
        const FixedShot& shot = shots[i];
        const bool sane = within_limit(shot.position) && std::abs(shot.yaw) <= full_turn &&
                          std::abs(shot.pitch) < quarter_turn;
        if (!sane) return at("fixed shot", i, "is not finite or out of range");
        if (shot.spawn_point != none && shot.spawn_point >= spawn_point_count)
            return at("fixed shot", i, "is named by a spawn point that does not exist");
    }
    return {};
}

std::string find_mesh_flaw(std::span<const Vertex> vertices, std::span<const Triangle> triangles) {
    std::string flaw = flaw_of_vertices(vertices);
    if (flaw.empty()) flaw = flaw_of_triangles(triangles, vertices.size());
    return flaw;
}

std::string find_bounds_flaw(const Box3f& bounds, std::span<const Vertex> vertices) {
    for (int axis = 0; axis < 3; ++axis)
        if (!within_limit(bounds.min()[axis]) || !within_limit(bounds.max()[axis]))
            return "the bounds are not finite or out of range";
    for (std::size_t i = 0; i < vertices.size(); ++i)
        if (!bounds.contains(vertices[i].position())) return at("vertex", i, "lies outside the bounds");
    return {};
}

std::string find_hints_flaw(const HintView& hints, std::size_t triangle_count) {
    // Counts up to 2^20 are exact as floats, and their product fits.
    constexpr std::uint32_t limit = 1U << 20U;
    std::uint64_t cells = 1;
    for (const std::uint32_t count : hints.extent) {
        if (count > limit) return "the grid of hints is too large";
        cells *= count;
    }
    if (cells != hints.triangles.size() || !(hints.cell_size > 0.0F) || !within_limit(hints.cell_size))
        return "the grid of hints does not fit its size";
    for (std::size_t i = 0; i < hints.triangles.size(); ++i)
        if (hints.triangles[i] >= triangle_count && hints.triangles[i] != none)
            return at("hint", i, "is a triangle that does not exist");
    return {};
}

}  // namespace camdir::freespace
