#include "bake/reduction/edge_collapser.hpp"

#include <algorithm>

namespace camdir::bake {
namespace {

constexpr double flattest_triangle = 1e-3;  // height over longest side
// Where nothing is lost, short edges go first.
constexpr double loss_of_length = 0.005;

bool is_flat(const Triangle3d& t) {
    const double longest2 =
        std::max({(t[1] - t[0]).squaredNorm(), (t[2] - t[1]).squaredNorm(), (t[0] - t[2]).squaredNorm()});
    return 2.0 * area(t) < flattest_triangle * longest2;
}

freespace::Triangle triangle_of(const Complex::Corners& corners) {
    return {corners[0], corners[1], corners[2]};
}

}  // namespace

void Collapses::run(std::uint64_t wanted, const Stage& stage) {
    for (const std::uint32_t vertex : vertices_)
        enqueue(vertex);
    while (!queue_.empty() && removed_ < wanted && !stage.stopping()) {
        const Candidate next = queue_.top();
        queue_.pop();
        State& state = state_of(next.from);
        state.queued = false;
        if (!state.changed) {
            if (collapse(next.from, next.to)) continue;
            state.refused.push_back(next.to);
        }
        enqueue(next.from);
    }
}

double Collapses::star_area(std::uint32_t vertex) const {
    double sum = 0.0;
    for (const std::uint32_t triangle : all_.complex.star(vertex))
        sum += area(all_.corners(triangle_of(all_.complex.corners(triangle))));
    return sum;
}

// Queues the vertex's cheapest collapse.
void Collapses::enqueue(std::uint32_t vertex) {
    State& state = state_of(vertex);
    state.changed = false;
    if (all_.complex.star(vertex).empty()) return;
    all_.complex.neighbours(vertex, neighbours_);
    if (!std::all_of(neighbours_.begin(), neighbours_.end(), [&](std::uint32_t n) { return is_mine(n); }))
        return;
    const std::optional<Target> best = cheapest_target(vertex, state);
    if (!best) return;
    // Two sides of a third of the star, thinner by what is lost.
    state.lost_volume = 2.0 / 3.0 * star_area(vertex) * best->cost;
    state.queued = true;
    queue_.push({state.lost_volume, vertex, best->to});
}

// The neighbour that may take the vertex's place at the least cost. The length alone bounds the cost from
// below, so that most neighbours need not be looked at.
std::optional<Collapses::Target> Collapses::cheapest_target(std::uint32_t vertex, const State& state) {
    targets_.clear();
    for (const std::uint32_t to : neighbours_)
        if (may_take_place(vertex, to, state)) targets_.push_back({cost_of_length(vertex, to), to, false});
    std::make_heap(targets_.begin(), targets_.end());
    while (!targets_.empty()) {
        std::pop_heap(targets_.begin(), targets_.end());
        Target& least = targets_.back();
        if (least.known) return least;
        const double lost = lost_distance(vertex, least.to);
        if (lost <= most_loss_) {
            least = {std::max(lost, 0.0) + least.cost, least.to, true};
            std::push_heap(targets_.begin(), targets_.end());
        } else {
            targets_.pop_back();
        }
    }
    return std::nullopt;
}

double Collapses::cost_of_length(std::uint32_t from, std::uint32_t to) const {
    return loss_of_length * (all_.position(to) - all_.position(from)).norm();
}

// As far as is known without a look at the slabs.
bool Collapses::may_take_place(std::uint32_t vertex, std::uint32_t to, const State& state) const {
    // A vertex of the roadmap must stay on it.
    if (has_ball(vertex) && !has_ball(to)) return false;
    if (std::find(state.refused.begin(), state.refused.end(), to) != state.refused.end()) return false;
    const auto& certified = all_.certified[vertex];
    return std::none_of(certified.begin(), certified.end(),
                        [&](const auto& known) { return known.to == to && !known.free; });
}

// At the vertex itself, when `to` takes its place.
double Collapses::lost_distance(std::uint32_t vertex, std::uint32_t to) {
    if (!has_ball(vertex)) return 0.0;
    find_moved(vertex, to);
    return all_.vertices[vertex].free_distance -
           find_home(all_.vertices, homes_, all_.position(vertex)).distance;
}

void Collapses::surroundings_changed(std::span<const std::uint32_t> vertices) {
    for (const std::uint32_t near : vertices) {
        State& state = state_of(near);
        state.changed = true;
        state.refused.clear();
        all_.certified[near].clear();
        if (state.queued) continue;
        state.queued = true;
        queue_.push({state.lost_volume, near, near});
    }
}

void Collapses::find_moved(std::uint32_t from, std::uint32_t to) {
    homes_.clear();
    home_ids_.clear();
    for (const std::uint32_t triangle : all_.complex.star(from)) {
        Complex::Corners corners = all_.complex.corners(triangle);
        if (corners[0] == to || corners[1] == to || corners[2] == to) continue;
        for (std::uint32_t& corner : corners)
            corner = corner == from ? to : corner;
        homes_.push_back(triangle_of(corners));
        home_ids_.push_back(triangle);
    }
    moved_count_ = homes_.size();
}

// No moved triangle is flat or comes too near to an obstacle.
bool Collapses::moved_is_free(std::uint32_t from, std::uint32_t to) {
    auto& certified = all_.certified[from];
    for (const auto& known : certified) {
        if (known.to == to) return known.free;
    }
    const bool free =
        std::none_of(homes_.begin(), homes_.end(),
                     [&](const freespace::Triangle& moved) { return is_flat(all_.corners(moved)); }) &&
        slabs_are_free(from);
    certified.push_back({to, free});
    return free;
}

// Those of the moved triangles.
bool Collapses::slabs_are_free(std::uint32_t from) {
    slabs_.clear();
    for (const freespace::Triangle& moved : homes_)
        slabs_.push_back(all_.slab(moved));
    const std::uint32_t violated = find_violated(slabs_, all_.obstacles, all_.suspect[from]);
    if (violated != freespace::none) all_.suspect[from] = violated;
    return violated == freespace::none;
}

// Settles the witnesses of the triangles at `from`. False when one would lose too much.
bool Collapses::find_homes(std::uint32_t from, std::uint32_t to) {
    for (const std::uint32_t triangle : all_.complex.star(to)) {
        const Complex::Corners& corners = all_.complex.corners(triangle);
        if (all_.complex.contains(triangle, from) || !is_mine(corners)) continue;
        homes_.push_back(triangle_of(corners));
        home_ids_.push_back(triangle);
    }
    settled_.clear();
    for (const std::uint32_t triangle : all_.complex.star(from)) {
        for (const Witness& witness : all_.witnesses[triangle]) {
            const Home home = find_home(all_.vertices, homes_, witness.point);
            if (!(home.distance >= std::max(witness.free_distance - most_loss_, witness.least))) return false;
            settled_.emplace_back(home_ids_[home.position], witness);
        }
    }
    return true;
}

bool Collapses::collapse(std::uint32_t from, std::uint32_t to) {
    // Not before: the triangles beyond the star, which have a say in it, may have changed.
    if (!all_.complex.can_collapse(from, to)) return false;
    find_moved(from, to);
    if (!moved_is_free(from, to) || !find_homes(from, to)) return false;
    for (const std::uint32_t triangle : all_.complex.star(from))
        all_.witnesses[triangle].clear();
    for (const auto& [home, witness] : settled_)
        all_.witnesses[home].push_back(witness);
    all_.complex.neighbours(from, neighbours_);
    removed_ += all_.complex.star(from).size() - moved_count_;
    all_.complex.collapse(from, to);
    surroundings_changed(neighbours_);
    return true;
}

}  // namespace camdir::bake
