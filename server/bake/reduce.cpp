#include "bake/reduce.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <tuple>
#include <utility>

#include "bake/certificate.hpp"
#include "bake/complex.hpp"
#include "bake/regions.hpp"

namespace camdir::bake {
namespace {

constexpr std::size_t region_size =
    4096;  // vertices: small enough to share out, large enough to have an inside
constexpr double flattest_triangle = 1e-3;  // height over longest side
// The allowed loss grows from round to round, so that the cheap collapses of the whole map come first.
constexpr double first_share = 1.0 / 32.0;
constexpr double share_factor = 1.5;
constexpr int last_rounds = 3;  // with the whole loss allowed, each with its borders elsewhere
constexpr std::array<double, 3> cuts{0.5, 0.36, 0.61};

// A point of the unreduced mesh that must stay covered: a vertex, or a spawn point.
struct Witness {
    Vec3d point;
    double free_distance;
};

// The mesh while it shrinks, and what every region needs to know of it.
struct Shrinking {
    Shrinking(const MedialMesh& whole, const std::vector<float>& free_distances, const Obstacles& around,
              const Reduction& wanted)
        : mesh(whole),
          free_distance(free_distances),
          obstacles(around),
          reduction(wanted),
          complex(whole),
          witnesses(whole.triangles.size()),
          uncertified(whole.vertices.size()),
          region_of(whole.vertices.size(), freespace::none) {}

    [[nodiscard]] Slab slab(const Complex::Corners& corners) const {
        return {{mesh.position(corners[0]), mesh.position(corners[1]), mesh.position(corners[2])},
                {free_distance[corners[0]], free_distance[corners[1]], free_distance[corners[2]]}};
    }
    [[nodiscard]] double allowed_loss(double distance) const {
        return reduction.loss_absolute + reduction.loss_relative * distance;
    }

    const MedialMesh& mesh;
    const std::vector<float>& free_distance;
    const Obstacles& obstacles;
    const Reduction& reduction;
    Complex complex;
    std::vector<std::vector<Witness>> witnesses;  // of each triangle: those that it covers
    std::vector<std::vector<std::uint32_t>>
        uncertified;                       // of each vertex: where it cannot go until its star changes
    std::vector<std::uint32_t> region_of;  // in this round
};

double area_of(const Triangle3d& t) {
    return 0.5 * (t[1] - t[0]).cross(t[2] - t[0]).norm();
}

bool is_flat(const Triangle3d& t) {
    const double longest2 =
        std::max({(t[1] - t[0]).squaredNorm(), (t[2] - t[1]).squaredNorm(), (t[0] - t[2]).squaredNorm()});
    return 2.0 * area_of(t) < flattest_triangle * longest2;
}

// One region in one round: a queue of collapses, those that lose the least volume first. Touches triangles
// whose three corners are in the region, and nothing else that another region reads.
class Region {
  public:
    Region(Shrinking& shrinking, const std::vector<std::uint32_t>& vertices, std::uint32_t number,
           double share)
        : all_(shrinking), vertices_(vertices), number_(number), share_(share), states_(vertices.size()) {}

    void run(const Stage& stage) {
        for (const std::uint32_t vertex : vertices_)
            enqueue(vertex);
        while (!queue_.empty() && !stage.stopping()) {
            const Candidate next = queue_.top();
            queue_.pop();
            State& state = state_of(next.from);
            state.queued = false;
            if (state.changed) {
                enqueue(next.from);
            } else if (collapse(next.from, next.to)) {
                surroundings_changed(next.to);
            } else {
                state.refused.push_back(next.to);
                enqueue(next.from);
            }
        }
    }

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
    struct Moved {
        std::uint32_t triangle;
        Slab slab;
    };

    State& state_of(std::uint32_t vertex) {
        const auto place = std::lower_bound(vertices_.begin(), vertices_.end(), vertex);
        return states_[static_cast<std::size_t>(place - vertices_.begin())];
    }
    [[nodiscard]] bool is_mine(std::uint32_t vertex) const { return all_.region_of[vertex] == number_; }
    [[nodiscard]] bool is_mine(const Complex::Corners& corners) const {
        return is_mine(corners[0]) && is_mine(corners[1]) && is_mine(corners[2]);
    }

    void enqueue(std::uint32_t vertex);
    void surroundings_changed(std::uint32_t vertex);
    [[nodiscard]] double lost_distance(std::uint32_t from, std::uint32_t to) const;
    [[nodiscard]] bool collapse(std::uint32_t from, std::uint32_t to);
    [[nodiscard]] bool find_moved(std::uint32_t from, std::uint32_t to, std::vector<Moved>& moved) const;
    [[nodiscard]] bool find_homes(std::uint32_t from);
    [[nodiscard]] double star_area(std::uint32_t vertex) const;

    Shrinking& all_;
    const std::vector<std::uint32_t>& vertices_;  // ascending
    std::uint32_t number_;
    double share_;
    std::vector<State> states_;
    std::priority_queue<Candidate> queue_;

    // Scratch.
    std::vector<std::uint32_t> neighbours_;
    std::vector<Moved> moved_;                                // what the triangles at `from` become
    std::vector<Moved> homes_;                                // what may cover their witnesses
    std::vector<std::pair<std::uint32_t, Witness>> settled_;  // witnesses with their new triangles
};

double Region::star_area(std::uint32_t vertex) const {
    double area = 0.0;
    for (const std::uint32_t triangle : all_.complex.star(vertex)) {
        const Complex::Corners& c = all_.complex.corners(triangle);
        area += area_of({all_.mesh.position(c[0]), all_.mesh.position(c[1]), all_.mesh.position(c[2])});
    }
    return area;
}

// Chooses the vertex's cheapest collapse that the topology allows and queues it.
void Region::enqueue(std::uint32_t vertex) {
    State& state = state_of(vertex);
    state.changed = false;
    if (all_.complex.star(vertex).empty()) return;
    all_.complex.neighbours(vertex, neighbours_);
    if (!std::all_of(neighbours_.begin(), neighbours_.end(), [&](std::uint32_t n) { return is_mine(n); }))
        return;

    const double distance = all_.free_distance[vertex];
    const double limit = share_ * all_.allowed_loss(std::max(distance, 0.0));
    const std::vector<std::uint32_t>& uncertified = all_.uncertified[vertex];
    double least = std::numeric_limits<double>::infinity();
    std::uint32_t best = freespace::none;
    for (const std::uint32_t to : neighbours_) {
        // A vertex of the roadmap must stay on it.
        if (distance > 0.0 && all_.free_distance[to] <= 0.0F) continue;
        if (std::find(state.refused.begin(), state.refused.end(), to) != state.refused.end()) continue;
        if (std::find(uncertified.begin(), uncertified.end(), to) != uncertified.end()) continue;
        if (!all_.complex.can_collapse(vertex, to)) continue;
        const double lost = distance > 0.0 ? lost_distance(vertex, to) : 0.0;
        if (lost < least && lost <= limit) {
            least = lost;
            best = to;
        }
    }
    if (best == freespace::none) return;
    // Two sides of a third of the star, thinner by what is lost.
    state.lost_volume = 2.0 / 3.0 * star_area(vertex) * std::max(least, 0.0);
    state.queued = true;
    queue_.push({state.lost_volume, vertex, best});
}

// Of the ball at `from` itself, when `from` is merged into `to`.
double Region::lost_distance(std::uint32_t from, std::uint32_t to) const {
    const Vec3d point = all_.mesh.position(from);
    double distance = -std::numeric_limits<double>::infinity();
    for (const std::uint32_t triangle : all_.complex.star(from)) {
        if (all_.complex.contains(triangle, to)) continue;
        Complex::Corners corners = all_.complex.corners(triangle);
        *std::find(corners.begin(), corners.end(), from) = to;
        distance = std::max(distance, all_.slab(corners).distance(point));
    }
    return all_.free_distance[from] - distance;
}

void Region::surroundings_changed(std::uint32_t vertex) {
    all_.complex.neighbours(vertex, neighbours_);
    neighbours_.push_back(vertex);
    for (const std::uint32_t near : neighbours_) {
        if (!is_mine(near)) continue;
        State& state = state_of(near);
        state.changed = true;
        state.refused.clear();
        all_.uncertified[near].clear();
        if (state.queued) continue;
        state.queued = true;
        queue_.push({state.lost_volume, near, near});
    }
}

// Certifies what the triangles at `from` become. False when one is flat or comes too near to an obstacle.
bool Region::find_moved(std::uint32_t from, std::uint32_t to, std::vector<Moved>& moved) const {
    moved.clear();
    for (const std::uint32_t triangle : all_.complex.star(from)) {
        if (all_.complex.contains(triangle, to)) continue;
        Complex::Corners corners = all_.complex.corners(triangle);
        *std::find(corners.begin(), corners.end(), from) = to;
        if (is_flat({all_.mesh.position(corners[0]), all_.mesh.position(corners[1]),
                     all_.mesh.position(corners[2])}))
            return false;
        moved.push_back({triangle, all_.slab(corners)});
    }
    return std::all_of(moved.begin(), moved.end(),
                       [&](const Moved& m) { return is_certified(m.slab, all_.obstacles); });
}

// Settles the witnesses of the triangles at `from` in homes_. False when one would lose too much.
bool Region::find_homes(std::uint32_t from) {
    settled_.clear();
    for (const std::uint32_t triangle : all_.complex.star(from)) {
        for (const Witness& witness : all_.witnesses[triangle]) {
            const double needed = witness.free_distance - share_ * all_.allowed_loss(witness.free_distance);
            double best = -std::numeric_limits<double>::infinity();
            std::uint32_t home = freespace::none;
            for (const Moved& candidate : homes_) {
                const double distance = candidate.slab.distance(witness.point);
                if (distance > best) {
                    best = distance;
                    home = candidate.triangle;
                }
            }
            if (!(best >= needed)) return false;
            settled_.emplace_back(home, witness);
        }
    }
    return true;
}

bool Region::collapse(std::uint32_t from, std::uint32_t to) {
    if (!find_moved(from, to, moved_)) {
        all_.uncertified[from].push_back(to);
        return false;
    }
    homes_ = moved_;
    for (const std::uint32_t triangle : all_.complex.star(to)) {
        const Complex::Corners& corners = all_.complex.corners(triangle);
        if (!all_.complex.contains(triangle, from) && is_mine(corners))
            homes_.push_back({triangle, all_.slab(corners)});
    }
    if (!find_homes(from)) return false;
    for (const std::uint32_t triangle : all_.complex.star(from))
        all_.witnesses[triangle].clear();
    for (const auto& [home, witness] : settled_)
        all_.witnesses[home].push_back(witness);
    all_.complex.collapse(from, to);
    return true;
}

// Every vertex with a ball is a witness of the slab that gives it the most, every spawn point likewise.
void place_witnesses(Shrinking& shrinking, const scene::Scene& scene) {
    for (std::uint32_t vertex = 0; vertex < shrinking.mesh.vertices.size(); ++vertex) {
        const auto star = shrinking.complex.star(vertex);
        const double distance = shrinking.free_distance[vertex];
        if (distance > 0.0 && !star.empty())
            shrinking.witnesses[star.front()].push_back({shrinking.mesh.position(vertex), distance});
    }
    for (const scene::SpawnPoint& spawn : scene.spawn_points) {
        double best = 0.0;
        std::uint32_t home = freespace::none;
        for (std::uint32_t triangle = 0; triangle < shrinking.mesh.triangles.size(); ++triangle) {
            const double distance = shrinking.slab(shrinking.complex.corners(triangle)).distance(spawn.eye);
            if (distance > best) {
                best = distance;
                home = triangle;
            }
        }
        if (home != freespace::none) shrinking.witnesses[home].push_back({spawn.eye, best});
    }
}

std::vector<std::uint32_t> used_vertices(const Complex& complex, std::size_t vertex_count) {
    std::vector<std::uint32_t> used;
    for (std::uint32_t vertex = 0; vertex < vertex_count; ++vertex) {
        if (!complex.star(vertex).empty()) used.push_back(vertex);
    }
    return used;
}

// Collapses what loses at most `share` of the allowed loss, in all regions at once.
bool run_round(Shrinking& shrinking, double share, double cut, Stage& stage) {
    const auto used = used_vertices(shrinking.complex, shrinking.mesh.vertices.size());
    const auto regions = make_regions(shrinking.mesh.vertices, used, region_size, cut);
    for (std::uint32_t i = 0; i < regions.size(); ++i) {
        for (const std::uint32_t vertex : regions[i])
            shrinking.region_of[vertex] = i;
    }
    return stage.for_each(regions.size(), [&](std::uint64_t i) {
        Region(shrinking, regions[i], static_cast<std::uint32_t>(i), share).run(stage);
    });
}

void compact(MedialMesh& mesh, std::vector<float>& free_distance,
             std::vector<freespace::Triangle> triangles) {
    std::vector<std::uint32_t> place(mesh.vertices.size(), freespace::none);
    MedialMesh left;
    std::vector<float> left_distance;
    const auto moved = [&](std::uint32_t vertex) {
        if (place[vertex] == freespace::none) {
            place[vertex] = static_cast<std::uint32_t>(left.vertices.size());
            left.vertices.push_back(mesh.vertices[vertex]);
            left_distance.push_back(free_distance[vertex]);
        }
        return place[vertex];
    };
    for (const freespace::Triangle& t : triangles)
        left.triangles.push_back({moved(t.a), moved(t.b), moved(t.c)});
    mesh = std::move(left);
    free_distance = std::move(left_distance);
}

}  // namespace

Result<void> reduce(MedialMesh& mesh, std::vector<float>& free_distance, const scene::Scene& scene,
                    const Obstacles& obstacles, const Reduction& reduction, Stage& stage) {
    Shrinking shrinking(mesh, free_distance, obstacles, reduction);
    place_witnesses(shrinking, scene);

    int round = 0;
    int at_full_share = 0;
    for (double share = first_share; at_full_share < last_rounds;
         share = std::min(1.0, share * share_factor)) {
        if (share >= 1.0) ++at_full_share;
        const double cut = cuts[static_cast<std::size_t>(round++) % cuts.size()];
        if (!run_round(shrinking, share, cut, stage)) return stage.interrupted();
        if (reduction.triangles > 0 && shrinking.complex.triangle_count() <= reduction.triangles) break;
    }
    compact(mesh, free_distance, shrinking.complex.triangles());
    stage.count("vertices", static_cast<double>(mesh.vertices.size()));
    stage.count("triangles", static_cast<double>(mesh.triangles.size()));
    return {};
}

}  // namespace camdir::bake
