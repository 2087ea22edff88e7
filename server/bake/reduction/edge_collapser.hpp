// Half-edge collapses in one region of a mesh.
#pragma once

#include <cstdint>
#include <optional>
#include <queue>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "bake/reduction/decimation_state.hpp"
#include "bake/stage.hpp"

namespace camdir::bake {

// Where a vertex of the mesh is in this round.
struct RegionIndex {
    std::uint32_t region = freespace::none;
    std::uint32_t index = 0;  // among the region's vertices
};

// The collapses of one region in one round, in the order of a queue: the least lost freespace volume first.
// Touches triangles whose three corners are in the region, and nothing else that another region reads.
class EdgeCollapser {
  public:
    // A sample may lose `max_loss`. `indices` has an entry for each vertex of the mesh; `vertices` are those
    // of the region with the number `region`.
    EdgeCollapser(DecimationState& state, std::span<const RegionIndex> indices,
                  std::span<const std::uint32_t> vertices, std::uint32_t region, double max_loss)
        : state_(state),
          indices_(indices),
          vertices_(vertices),
          region_(region),
          max_loss_(max_loss),
          progress_(vertices.size()) {}

    // Ends when no collapse is allowed any more, when at least `target` triangles are gone, or soon after the
    // stage is asked to stop.
    void run(std::uint64_t target, const Stage& stage);

  private:
    struct Candidate {
        double lost_volume;
        std::uint32_t from, to;

        bool operator<(const Candidate& other) const {  // the queue's top is the largest
            return std::tie(lost_volume, from, to) > std::tie(other.lost_volume, other.from, other.to);
        }
    };
    // Of one vertex in this round.
    struct VertexProgress {
        bool queued = false;
        bool changed = false;                // since its candidate was chosen
        double lost_volume = 0.0;            // of the last candidate
        std::vector<std::uint32_t> refused;  // targets, until the star changes
    };
    struct Target {
        double cost;
        std::uint32_t to;
        bool known;  // else the cost is a lower bound

        bool operator<(const Target& other) const {  // a heap's top is the largest
            return std::tie(cost, to) > std::tie(other.cost, other.to);
        }
    };
    // The mesh around two neighbours as merging `from` into `to` would leave it. The slabs that may cover the
    // samples of `from`'s triangles: first the moved ones, which had `from` as a corner, then kept ones at
    // `to`.
    struct Collapse {
        std::uint32_t from = freespace::none;
        std::uint32_t to = freespace::none;
        std::size_t moved_count = 0;
        std::vector<freespace::Triangle> triangles;
        std::vector<std::uint32_t> ids;  // of these triangles in the complex
        // The samples with the triangle that covers them afterwards.
        std::vector<std::pair<std::uint32_t, ConstraintSample>> assigned;

        [[nodiscard]] std::span<const freespace::Triangle> moved() const {
            return std::span(triangles).first(moved_count);
        }
    };

    VertexProgress& progress_of(std::uint32_t vertex) { return progress_[indices_[vertex].index]; }
    [[nodiscard]] bool is_mine(std::uint32_t vertex) const { return indices_[vertex].region == region_; }
    [[nodiscard]] bool is_mine(const Complex::Corners& corners) const {
        return is_mine(corners[0]) && is_mine(corners[1]) && is_mine(corners[2]);
    }
    [[nodiscard]] bool has_ball(std::uint32_t vertex) const {
        return state_.vertices[vertex].free_distance > state_.reduction.offset_radius;
    }
    void enqueue(std::uint32_t vertex);
    [[nodiscard]] std::optional<Target> cheapest_target(std::uint32_t vertex);
    [[nodiscard]] bool may_collapse(std::uint32_t vertex, std::uint32_t to) const;
    [[nodiscard]] double cost_of_length(std::uint32_t from, std::uint32_t to) const;
    [[nodiscard]] double lost_distance(std::uint32_t vertex, std::uint32_t to);
    [[nodiscard]] double star_area(std::uint32_t vertex) const;
    [[nodiscard]] bool try_collapse(std::uint32_t from, std::uint32_t to);
    [[nodiscard]] Collapse& move_star(std::uint32_t from, std::uint32_t to);
    [[nodiscard]] bool is_certified(const Collapse& collapse);
    [[nodiscard]] bool slabs_are_free(const Collapse& collapse);
    [[nodiscard]] bool assign_samples(Collapse& collapse) const;
    void apply(const Collapse& collapse);
    void surroundings_changed(std::span<const std::uint32_t> vertices);

    DecimationState& state_;
    std::span<const RegionIndex> indices_;
    std::span<const std::uint32_t> vertices_;
    std::uint32_t region_;
    double max_loss_;
    std::vector<VertexProgress> progress_;
    std::priority_queue<Candidate> queue_;
    std::uint64_t removed_ = 0;  // triangles

    // Memory that is used again; nothing is read from it that the same call did not write.
    std::vector<std::uint32_t> neighbours_;
    std::vector<Target> targets_;
    Collapse collapse_;
    std::vector<Slab> slabs_;
};

}  // namespace camdir::bake
