#include "bake/reduction/edge_collapser.hpp"

#include <algorithm>

namespace camdir::bake {
namespace {

constexpr double min_relative_height = 1e-3;  // of a triangle, over its longest side
// Where nothing is lost, short edges go first.
constexpr double loss_of_length = 0.005;

bool is_flat(const Triangle3d& t) {
    const double longest2 =
        std::max({(t[1] - t[0]).squaredNorm(), (t[2] - t[1]).squaredNorm(), (t[0] - t[2]).squaredNorm()});
    return 2.0 * area(t) < min_relative_height * longest2;
}

freespace::Triangle triangle_of(const Complex::Corners& corners) {
    return {corners[0], corners[1], corners[2]};
}

}  // namespace

void EdgeCollapser::run(std::uint64_t target, const Stage& stage) {
    for (const std::uint32_t vertex : vertices_)
        enqueue(vertex);
    while (!queue_.empty() && removed_ < target && !stage.stopping()) {
        const Candidate next = queue_.top();
        queue_.pop();
        VertexProgress& progress = progress_of(next.from);
        progress.queued = false;
        if (!progress.changed) {
            if (try_collapse(next.from, next.to)) continue;
            progress.refused.push_back(next.to);
        }
        enqueue(next.from);
    }
}

double EdgeCollapser::star_area(std::uint32_t vertex) const {
    double sum = 0.0;
    for (const std::uint32_t triangle : state_.complex.star(vertex))
        sum += area(state_.corners(triangle_of(state_.complex.corners(triangle))));
    return sum;
}

// Queues the vertex's cheapest collapse.
void EdgeCollapser::enqueue(std::uint32_t vertex) {
    VertexProgress& progress = progress_of(vertex);
    progress.changed = false;
    if (state_.complex.star(vertex).empty()) return;
    const std::optional<Target> best = cheapest_target(vertex);
    if (!best) return;
    // Two sides of a third of the star, thinner by what is lost.
    progress.lost_volume = 2.0 / 3.0 * star_area(vertex) * best->cost;
    progress.queued = true;
    queue_.push({progress.lost_volume, vertex, best->to});
}

// The neighbour into which the vertex may be merged at the least cost; none when a neighbour is in another
// region. The length alone bounds the cost from below, so that most neighbours need not be examined.
std::optional<EdgeCollapser::Target> EdgeCollapser::cheapest_target(std::uint32_t vertex) {
    state_.complex.neighbours(vertex, neighbours_);
    if (!std::all_of(neighbours_.begin(), neighbours_.end(), [&](std::uint32_t n) { return is_mine(n); }))
        return std::nullopt;
    targets_.clear();
    for (const std::uint32_t to : neighbours_)
        if (may_collapse(vertex, to)) targets_.push_back({cost_of_length(vertex, to), to, false});
    std::make_heap(targets_.begin(), targets_.end());
    while (!targets_.empty()) {
        std::pop_heap(targets_.begin(), targets_.end());
        Target& least = targets_.back();
        if (least.known) return least;
        const double lost = lost_distance(vertex, least.to);
        if (lost <= max_loss_) {
            least = {std::max(lost, 0.0) + least.cost, least.to, true};
            std::push_heap(targets_.begin(), targets_.end());
        } else {
            targets_.pop_back();
        }
    }
    return std::nullopt;
}

double EdgeCollapser::cost_of_length(std::uint32_t from, std::uint32_t to) const {
    return loss_of_length * (state_.position(to) - state_.position(from)).norm();
}

// As far as is known without examining the slabs.
bool EdgeCollapser::may_collapse(std::uint32_t vertex, std::uint32_t to) const {
    // A vertex of the roadmap must stay on it.
    if (has_ball(vertex) && !has_ball(to)) return false;
    const std::vector<std::uint32_t>& refused = progress_[indices_[vertex].index].refused;
    if (std::find(refused.begin(), refused.end(), to) != refused.end()) return false;
    const auto& certified = state_.certified[vertex];
    return std::none_of(certified.begin(), certified.end(),
                        [&](const auto& known) { return known.to == to && !known.free; });
}

// At the vertex itself, when it is merged into `to`.
double EdgeCollapser::lost_distance(std::uint32_t vertex, std::uint32_t to) {
    if (!has_ball(vertex)) return 0.0;
    const Collapse& collapse = move_star(vertex, to);
    return state_.vertices[vertex].free_distance -
           find_covering_slab(state_.vertices, collapse.moved(), state_.position(vertex)).distance;
}

bool EdgeCollapser::try_collapse(std::uint32_t from, std::uint32_t to) {
    // Not when it was queued: triangles beyond the star, which the answer depends on, may have changed since.
    if (!state_.complex.can_collapse(from, to)) return false;
    Collapse& collapse = move_star(from, to);
    if (!is_certified(collapse) || !assign_samples(collapse)) return false;
    apply(collapse);
    return true;
}

// A collapse with its moved triangles only. Valid until the next call.
EdgeCollapser::Collapse& EdgeCollapser::move_star(std::uint32_t from, std::uint32_t to) {
    Collapse& collapse = collapse_;
    collapse.from = from;
    collapse.to = to;
    collapse.triangles.clear();
    collapse.ids.clear();
    collapse.assigned.clear();
    for (const std::uint32_t triangle : state_.complex.star(from)) {
        Complex::Corners corners = state_.complex.corners(triangle);
        if (corners[0] == to || corners[1] == to || corners[2] == to) continue;
        for (std::uint32_t& corner : corners)
            corner = corner == from ? to : corner;
        collapse.triangles.push_back(triangle_of(corners));
        collapse.ids.push_back(triangle);
    }
    collapse.moved_count = collapse.triangles.size();
    return collapse;
}

// No moved triangle is flat or reaches into an obstacle. Remembers the answer until the surroundings change.
bool EdgeCollapser::is_certified(const Collapse& collapse) {
    auto& certified = state_.certified[collapse.from];
    for (const auto& known : certified)
        if (known.to == collapse.to) return known.free;
    const auto moved = collapse.moved();
    const auto flat = [&](const freespace::Triangle& triangle) { return is_flat(state_.corners(triangle)); };
    const bool free = std::none_of(moved.begin(), moved.end(), flat) && slabs_are_free(collapse);
    certified.push_back({collapse.to, free});
    return free;
}

bool EdgeCollapser::slabs_are_free(const Collapse& collapse) {
    slabs_.clear();
    for (const freespace::Triangle& moved : collapse.moved())
        slabs_.push_back(state_.slab(moved));
    std::uint32_t& last_violated = state_.last_violated[collapse.from];
    const std::uint32_t violated = find_violated(slabs_, state_.obstacles, last_violated);
    if (violated != freespace::none) last_violated = violated;
    return violated == freespace::none;
}

// Finds covering slabs for the samples of the triangles at `from`. False when a sample would lose too much.
bool EdgeCollapser::assign_samples(Collapse& collapse) const {
    for (const std::uint32_t triangle : state_.complex.star(collapse.to)) {
        const Complex::Corners& corners = state_.complex.corners(triangle);
        if (state_.complex.contains(triangle, collapse.from) || !is_mine(corners)) continue;
        collapse.triangles.push_back(triangle_of(corners));
        collapse.ids.push_back(triangle);
    }
    for (const std::uint32_t triangle : state_.complex.star(collapse.from)) {
        for (const ConstraintSample& sample : state_.samples[triangle]) {
            const CoveringSlab slab = find_covering_slab(state_.vertices, collapse.triangles, sample.point);
            const double required = std::max(sample.unreduced_distance - max_loss_, sample.min_distance);
            if (!(slab.distance >= required)) return false;
            collapse.assigned.emplace_back(collapse.ids[slab.position], sample);
        }
    }
    return true;
}

void EdgeCollapser::apply(const Collapse& collapse) {
    const auto star = state_.complex.star(collapse.from);
    for (const std::uint32_t triangle : star)
        state_.samples[triangle].clear();
    for (const auto& [triangle, sample] : collapse.assigned)
        state_.samples[triangle].push_back(sample);
    removed_ += star.size() - collapse.moved_count;
    state_.complex.neighbours(collapse.from, neighbours_);
    state_.complex.collapse(collapse.from, collapse.to);
    surroundings_changed(neighbours_);
}

void EdgeCollapser::surroundings_changed(std::span<const std::uint32_t> vertices) {
    for (const std::uint32_t near : vertices) {
        VertexProgress& progress = progress_of(near);
        progress.changed = true;
        progress.refused.clear();
        state_.certified[near].clear();
        if (progress.queued) continue;
        progress.queued = true;
        queue_.push({progress.lost_volume, near, near});
    }
}

}  // namespace camdir::bake
