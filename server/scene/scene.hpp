// A Scene is the obstacles of one map, whatever the format it came in: the paper's S (section 3).
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/geometry.hpp"
#include "scene/read_options.hpp"

namespace camdir::scene {

// Obstacle half space: points with normal.dot(p) <= distance are on the solid's side. `normal` has length 1.
struct Plane {
    Vec3d normal;
    double distance;
};

// A convex solid: the intersection of planes[first_plane .. first_plane + plane_count).
struct Brush {
    std::uint32_t first_plane;
    std::uint32_t plane_count;
    Box3d bounds;
};

// Like Brush, with planes of its own.
struct ConvexPart {
    std::vector<Plane> planes;
    Box3d bounds;
};

// A brush model that moves during the game: no obstacle of the scene. Its solid parts are where they are
// before a position is added.
struct Mover {
    std::string name;               // "*3": the third brush model
    std::string kind;               // the entity's class, at most 64 bytes
    std::vector<ConvexPart> parts;  // at least one
    Vec3d rest;                     // the position that the map gives the entity
};

struct SpawnPoint {
    Vec3d eye;         // where a spawned player's eye is
    double yaw = 0.0;  // radians, 0 looks along x, counter-clockwise seen from above
    std::string kind;  // the format's own name for it: info_player_deathmatch, seed, ...
};

// Something the reader found in the source and skipped on purpose; `inspect` shows the reasons.
struct Skipped {
    std::string reason;       // liquid, not solid, kept as a mover: func_door, outside the world's box, ...
    std::string what;         // the texture or shader, the class of spawn points; empty: all with this reason
    std::uint64_t count = 0;  // surfaces; spawn points where the reason says so
    double area = 0.0;        // of those surfaces, square map units
};

struct Scene {
    std::string name;               // the map's name: file name without folder and extension
    std::string source;             // as the user named it: path, or archive.pk3:member
    std::uint64_t source_hash = 0;  // xxh3-64 of the map file's (or member's) bytes
    std::string kind;               // what it was read from: BSP, mesh (OBJ), point cloud (PCD), ...
    ReadOptions options;            // how
    double metres_per_unit = 1.0;

    // The obstacles' surfaces, welded: every index < vertices.size(), no triangle of zero area.
    std::vector<Vec3d> vertices;
    std::vector<std::array<std::uint32_t, 3>> triangles;

    // Of a point cloud, instead of triangles: points on the surfaces, ascending and all different. Neighbours
    // lie about `point_spacing` apart: for 95 % of the points the mean distance to the nearest 8 is at most
    // that.
    std::vector<Vec3d> points;
    double point_spacing = 0.0;

    // The obstacles' volumes where the format knows them, else empty: Quake 3's brushes, the solid leaves of
    // Quake's and GoldSrc's trees.
    std::vector<Plane> planes;
    std::vector<Brush> brushes;

    std::vector<Mover> movers;  // names are different; where the format knows volumes

    Box3d bounds;  // of the playable world; encloses `vertices` and `points`
    std::vector<SpawnPoint> spawn_points;
    std::vector<Skipped> skipped;
};

// The corners of triangle `index`.
[[nodiscard]] inline std::array<Vec3d, 3> corners(const Scene& scene, std::size_t index) {
    const auto& [a, b, c] = scene.triangles[index];
    return {scene.vertices[a], scene.vertices[b], scene.vertices[c]};
}

// Inside the brush or on its surface.
[[nodiscard]] inline bool contains(const Scene& scene, const Brush& brush, const Vec3d& point) {
    const auto planes = std::span(scene.planes).subspan(brush.first_plane, brush.plane_count);
    return std::all_of(planes.begin(), planes.end(),
                       [&](const Plane& plane) { return plane.normal.dot(point) <= plane.distance; });
}

}  // namespace camdir::scene
