#include "bench/paper/vertex_elimination.hpp"

#include <algorithm>
#include <cmath>
#include <queue>
#include <tuple>

#include "base/round_down.hpp"
#include "bench/paper/elimination.hpp"

namespace camdir::paper {
namespace {

// The priority queue of vertices by the volume that their elimination loses.
class Queue {
  public:
    explicit Queue(std::size_t vertex_count) : versions_(vertex_count, 0) {}

    void push(std::uint32_t vertex, double lost_volume) {
        entries_.push({lost_volume, vertex, ++versions_[vertex]});
    }
    void remove(std::uint32_t vertex) { ++versions_[vertex]; }
    [[nodiscard]] bool empty() {
        while (!entries_.empty() && entries_.top().version != versions_[entries_.top().vertex])
            entries_.pop();
        return entries_.empty();
    }
    // Of a queue that is not empty().
    std::pair<std::uint32_t, double> pop() {
        const Entry top = entries_.top();
        entries_.pop();
        return {top.vertex, top.lost_volume};
    }

  private:
    struct Entry {
        double lost_volume;
        std::uint32_t vertex;
        std::uint32_t version;

        bool operator<(const Entry& other) const {  // the queue's top is the largest
            return std::tie(lost_volume, vertex) > std::tie(other.lost_volume, other.vertex);
        }
    };
    std::priority_queue<Entry> entries_;
    std::vector<std::uint32_t> versions_;
};

class Reduction {
  public:
    Reduction(DynamicMesh& mesh, double threshold, bool seams)
        : mesh_(mesh), threshold_(threshold), seams_(seams), queue_(mesh.vertex_count()) {}

    void run() {
        for (std::uint32_t vertex = 0; vertex < mesh_.vertex_count(); ++vertex)
            evaluate(vertex);
        while (!queue_.empty()) {
            const auto [vertex, expected] = queue_.pop();
            const auto plan = plan_elimination(mesh_, vertex, seams_);
            if (!plan || !(plan->lost_volume < threshold_)) continue;
            // Changes beyond the direct neighbours may have raised its cost.
            if (plan->lost_volume > expected)
                queue_.push(vertex, plan->lost_volume);
            else
                execute(vertex, *plan);
        }
    }

  private:
    void evaluate(std::uint32_t vertex) {
        const auto plan = plan_elimination(mesh_, vertex, seams_);
        if (plan && plan->lost_volume < threshold_)
            queue_.push(vertex, plan->lost_volume);
        else
            queue_.remove(vertex);
    }

    void execute(std::uint32_t vertex, const Elimination& plan) {
        std::vector<std::uint32_t> around;
        for (const std::uint32_t triangle : mesh_.star(vertex)) {
            for (const std::uint32_t corner : mesh_.corners(triangle)) {
                if (corner != vertex) around.push_back(corner);
            }
        }
        std::sort(around.begin(), around.end());
        around.erase(std::unique(around.begin(), around.end()), around.end());

        mesh_.remove_star(vertex);
        for (const Corners& triangle : plan.triangles)
            mesh_.add(triangle);
        for (const auto& [lowered, value] : plan.lowered)
            mesh_.set_free_distance(lowered, round_down(value));
        for (const std::uint32_t neighbour : around)
            evaluate(neighbour);
    }

    DynamicMesh& mesh_;
    double threshold_;
    bool seams_;
    Queue queue_;
};

}  // namespace

void eliminate_vertices(bake::MedialMesh& mesh, std::vector<float>& free_distance, double threshold) {
    std::vector<Corners> triangles;
    for (const auto& [a, b, c] : mesh.triangles)
        triangles.push_back({a, b, c});
    DynamicMesh dynamic(mesh.vertices, free_distance, triangles);
    for (const bool seams : {false, true})
        Reduction(dynamic, threshold, seams).run();
    mesh.triangles.clear();
    for (const auto& [a, b, c] : dynamic.triangles())
        mesh.triangles.push_back({a, b, c});
}

}  // namespace camdir::paper
