// The medial mesh during its reduction, and what must stay covered meanwhile.
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
struct ConstraintSample {
    Vec3d point;
    double unreduced_distance;  // its free distance in the unreduced mesh
    // What it keeps whatever the loss.
    double min_distance = -std::numeric_limits<double>::infinity();
};

// The slab that gives the most free distance to a point.
struct CoveringSlab {
    std::uint32_t position = freespace::none;  // in the list of triangles
    double distance = -std::numeric_limits<double>::infinity();
};

// Searched in floats, measured in doubles: the slab has a ball that gives the point this distance.
[[nodiscard]] CoveringSlab find_covering_slab(std::span<const freespace::Vertex> vertices,
                                              std::span<const freespace::Triangle> triangles,
                                              const Vec3d& point);

// Parts that share no triangle may be changed by different threads.
struct DecimationState {
    // Every vertex with a ball is a sample of one of its slabs, every spawn point of the best slab there. The
    // obstacles must outlive the state.
    DecimationState(const MedialMesh& mesh, const std::vector<float>& free_distance,
                    const scene::Scene& scene, const Obstacles& around, const Reduction& limits);

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

    // Spends part of the loss on all vertices at once: lowers their free distances by `share` of the slack
    // reserved for that, which lets more collapses keep clear of the obstacles, and forgets the collapses
    // that were refused without it. A sample that lost at most half of `share` of the loss before has lost at
    // most all of it afterwards; one with a min_distance loses nothing.
    void spend_slack(double share);

    // Whether the slabs that a collapse would make are free.
    struct Certified {
        std::uint32_t to;
        bool free;
    };

    // The corners of triangles whose samples have a min_distance.
    [[nodiscard]] std::vector<bool> constrained_vertices() const;

    std::vector<freespace::Vertex> vertices;
    const std::vector<float> unreduced_distance;  // of the vertices
    const Obstacles& obstacles;
    const Reduction reduction;
    Complex complex;
    std::vector<std::vector<ConstraintSample>> samples;  // of each triangle: those that it covers
    std::vector<std::vector<Certified>> certified;       // of each vertex: its collapses that were examined
    std::vector<std::uint32_t> last_violated;            // of each vertex: the obstacle that refused it last
};

}  // namespace camdir::bake
