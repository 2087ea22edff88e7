// The medial mesh while collapses shrink it, and what must stay covered meanwhile.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "bake/geometry/certificate.hpp"
#include "bake/geometry/obstacles.hpp"
#include "bake/medial_mesh.hpp"
#include "bake/reduction/complex.hpp"
#include "bake/reduction/reduction.hpp"
#include "freespace/freespace.hpp"
#include "scene/scene.hpp"

namespace camdir::bake {

// A point that must stay covered: a vertex of the unreduced mesh, or a spawn point.
struct Witness {
    Vec3d point;
    double free_distance;                                     // in the unreduced mesh
    double least = -std::numeric_limits<double>::infinity();  // that it keeps whatever the loss
};

// The slab that gives the most free distance to a point.
struct Home {
    std::uint32_t position = freespace::none;  // in the list of triangles
    double distance = -std::numeric_limits<double>::infinity();
};

// Found in floats, measured in doubles: the slab has a ball that gives the point this distance.
[[nodiscard]] Home find_home(std::span<const freespace::Vertex> vertices,
                             std::span<const freespace::Triangle> triangles, const Vec3d& point);

// Parts that no triangle joins may be changed by different threads.
struct Shrinking {
    // Every vertex with a ball is a witness of one of its slabs, every spawn point of the best slab there.
    Shrinking(const MedialMesh& mesh, const std::vector<float>& free_distance, const scene::Scene& scene,
              const Obstacles& around, const Reduction& wanted);

    [[nodiscard]] Vec3d position(std::uint32_t vertex) const {
        return vertices[vertex].position().cast<double>();
    }
    [[nodiscard]] Triangle3d corners(const freespace::Triangle& t) const {
        return {position(t.a), position(t.b), position(t.c)};
    }
    [[nodiscard]] Slab slab(const freespace::Triangle& t) const {
        return {corners(t),
                {vertices[t.a].free_distance, vertices[t.b].free_distance, vertices[t.c].free_distance}};
    }

    // Lowers the free distances by `share` of the slack that the loss has for them, and forgets what was
    // refused for want of it. A witness that has lost at most half of `share` of the loss before has lost at
    // most all of it afterwards; one with a least free distance loses nothing.
    void give_slack(double share);

    // Whether the slabs that a collapse would make were found free.
    struct Certified {
        std::uint32_t to;
        bool free;
    };

    // The corners of triangles whose witnesses have a least free distance.
    [[nodiscard]] std::vector<bool> bound_vertices() const;

    std::vector<freespace::Vertex> vertices;
    const std::vector<float>& whole_distance;  // of the vertices in the unreduced mesh
    const Obstacles& obstacles;
    const Reduction& reduction;
    Complex complex;
    std::vector<std::vector<Witness>> witnesses;    // of each triangle: those that it covers
    std::vector<std::vector<Certified>> certified;  // of each vertex: its collapses that were looked at
    std::vector<std::uint32_t> suspect;             // of each vertex: the obstacle that was last in its way
};

}  // namespace camdir::bake
