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

// Where each vertex of the mesh is in this round.
struct Place {
    std::uint32_t region = freespace::none;
    std::uint32_t index = 0;  // among the region's vertices
};

// The collapses of one region in one round: a queue, those first that lose the least freespace volume.
// Touches triangles whose three corners are in the region, and nothing else that another region reads.
class Collapses {
  public:
    // A witness may lose `most_loss`. `places` has an entry for each vertex of the mesh; `vertices` are those
    // of the region with the number `region`.
    Collapses(Shrinking& shrinking, std::span<const Place> places, std::span<const std::uint32_t> vertices,
              std::uint32_t region, double most_loss)
        : all_(shrinking),
          places_(places),
          vertices_(vertices),
          region_(region),
          most_loss_(most_loss),
          states_(vertices.size()) {}

    // Ends when no collapse is allowed any more, when `wanted` or more triangles are gone, or soon after the
    // stage is asked to stop.
    void run(std::uint64_t wanted, const Stage& stage);

  private:
    struct Candidate {
        double lost_volume;
        std::uint32_t from, to;

        bool operator<(const Candidate& other) const {  // the queue's top is the largest
            return std::tie(lost_volume, from, to) > std::tie(other.lost_volume, other.from, other.to);
        }
    };
    struct State {
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

    State& state_of(std::uint32_t vertex) { return states_[places_[vertex].index]; }
    [[nodiscard]] bool is_mine(std::uint32_t vertex) const { return places_[vertex].region == region_; }
    [[nodiscard]] bool is_mine(const Complex::Corners& corners) const {
        return is_mine(corners[0]) && is_mine(corners[1]) && is_mine(corners[2]);
    }
    [[nodiscard]] bool has_ball(std::uint32_t vertex) const {
        return all_.vertices[vertex].free_distance > all_.reduction.margin;
    }
    void enqueue(std::uint32_t vertex);
    [[nodiscard]] std::optional<Target> cheapest_target(std::uint32_t vertex, const State& state);
    [[nodiscard]] bool may_take_place(std::uint32_t vertex, std::uint32_t to, const State& state) const;
    [[nodiscard]] double cost_of_length(std::uint32_t from, std::uint32_t to) const;
    [[nodiscard]] double lost_distance(std::uint32_t vertex, std::uint32_t to);
    [[nodiscard]] double star_area(std::uint32_t vertex) const;
    [[nodiscard]] bool collapse(std::uint32_t from, std::uint32_t to);
    void find_moved(std::uint32_t from, std::uint32_t to);
    [[nodiscard]] bool moved_is_free(std::uint32_t from, std::uint32_t to);
    [[nodiscard]] bool slabs_are_free(std::uint32_t from);
    [[nodiscard]] bool find_homes(std::uint32_t from, std::uint32_t to);
    void surroundings_changed(std::span<const std::uint32_t> vertices);

    Shrinking& all_;
    std::span<const Place> places_;
    std::span<const std::uint32_t> vertices_;
    std::uint32_t region_;
    double most_loss_;
    std::vector<State> states_;
    std::priority_queue<Candidate> queue_;
    std::uint64_t removed_ = 0;  // triangles

    // Scratch.
    std::vector<std::uint32_t> neighbours_;
    std::vector<Target> targets_;
    std::vector<freespace::Triangle> homes_;  // first what the triangles at `from` become, then those at `to`
    std::size_t moved_count_ = 0;             // of the first kind
    std::vector<Slab> slabs_;                 // of the moved triangles
    std::vector<std::uint32_t> home_ids_;     // the triangles that they are
    std::vector<std::pair<std::uint32_t, Witness>> settled_;  // witnesses with their new triangles
};

}  // namespace camdir::bake
