// The roadmap as a graph, with distances to landmarks that bound the length of every path.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/float4.hpp"
#include "freespace/freespace.hpp"

namespace camdir::freespace {

// Immutable. Vertices are those of V(S); those off the roadmap have no neighbours.
class RoadmapGraph {
  public:
    struct Arc {
        std::uint32_t to;
        float length;
    };
    // In two parts of four landmarks.
    static constexpr int landmark_count = 2 * lane_count;
    struct Landmarks {
        Float4 part[2];
    };

    RoadmapGraph() = default;
    // Time: that of a shortest-path tree a landmark.
    RoadmapGraph(std::span<const Vertex> vertices, std::span<const Triangle> triangles);

    [[nodiscard]] std::span<const Arc> arcs(std::uint32_t vertex) const {
        return std::span(arcs_).subspan(offsets_[vertex], offsets_[vertex + 1] - offsets_[vertex]);
    }
    [[nodiscard]] std::size_t arc_count() const { return arcs_.size(); }

    // The smallest vertex that each is joined to; none off the roadmap.
    [[nodiscard]] std::span<const std::uint32_t> components() const { return components_; }

    // Lengths of the shortest paths from the landmarks to the vertex; 0 where there is none.
    [[nodiscard]] const Landmarks& landmarks(std::uint32_t vertex) const { return landmarks_[vertex]; }

    [[nodiscard]] std::size_t memory() const;  // bytes

  private:
    void add_arcs(std::span<const Vertex> vertices, std::span<const Triangle> triangles);
    void number_components();
    void measure_landmarks();
    [[nodiscard]] std::vector<float> distances_from(std::uint32_t start) const;

    std::vector<std::uint32_t> offsets_;
    std::vector<Arc> arcs_;
    std::vector<std::uint32_t> components_;
    std::vector<Landmarks> landmarks_;
};

}  // namespace camdir::freespace
