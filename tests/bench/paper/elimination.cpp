#include "bench/paper/elimination.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bake/geometry/triangle.hpp"
#include "bench/paper/link.hpp"

namespace camdir::paper {
namespace {

constexpr double margin = 1e-3;             // of an edge's length: no new edge through an old vertex
constexpr double flattest_triangle = 1e-3;  // height over longest side

// A vertex around the one to be eliminated.
struct Neighbour {
    std::uint32_t vertex;
    Vec3d position;
    double free_distance;  // as the plan lowers it
    double outer_area;     // of its triangles that stay
};

struct Change {
    std::size_t neighbour;
    double free_distance;
};

// What a swap would do.
struct Step {
    double lost_volume = std::numeric_limits<double>::infinity();
    std::size_t position = 0;  // in the fan
    std::array<Change, 2> changes{};
};

struct Crossing {
    double along_old, along_new;  // 0 .. 1: where the edges are nearest to each other
    double distance;
};

// Nearest points of the old edge a-b and the new edge c-d. None where c-d passes beyond b or a, or where an
// end of c-d is nearest: the triangles after the swap would not cover the same area.
std::optional<Crossing> crossing(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d) {
    const Vec3d u = b - a;
    const Vec3d v = d - c;
    const Vec3d w = a - c;
    const double uu = u.squaredNorm();
    const double uv = u.dot(v);
    const double vv = v.squaredNorm();
    const double determinant = uu * vv - uv * uv;
    if (!(determinant > 1e-12 * uu * vv)) return std::nullopt;
    double s = (uv * v.dot(w) - vv * u.dot(w)) / determinant;
    constexpr double on_the_line = 1e-6;
    if (!(s > -on_the_line && s < 1.0 - margin)) return std::nullopt;
    s = std::max(s, 0.0);
    const double t = v.dot(w + s * u) / vv;
    if (!(t > margin && t < 1.0 - margin)) return std::nullopt;
    return Crossing{s, t, (w + s * u - t * v).norm()};
}

bool is_flat(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
    const double longest2 = std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
    return (b - a).cross(c - a).norm() < flattest_triangle * longest2;
}

// Barycentric coordinates of a point of the triangle.
std::array<double, 3> weights_of(const bake::Triangle3d& t, const Vec3d& q) {
    const Vec3d normal = (t[1] - t[0]).cross(t[2] - t[0]);
    std::array<double, 3> weights{};
    double sum = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3d& b = t[(i + 1) % 3];
        weights[i] = std::max(0.0, (t[(i + 2) % 3] - b).cross(q - b).dot(normal));
        sum += weights[i];
    }
    for (double& weight : weights)
        weight /= sum;
    return weights;
}

// Freespace of a triangle: twice the integral of its free distance.
double volume(double area, double ra, double rb, double rc) {
    return 2.0 / 3.0 * area * (std::max(ra, 0.0) + std::max(rb, 0.0) + std::max(rc, 0.0));
}

// Tries the elimination of one vertex.
class Planner {
  public:
    Planner(const DynamicMesh& mesh, std::uint32_t vertex)
        : mesh_(mesh),
          vertex_(vertex),
          centre_(mesh.position(vertex)),
          free_distance_(mesh.free_distance(vertex)) {}

    [[nodiscard]] std::optional<Elimination> plan(const Surroundings& around) {
        collect_neighbours();
        std::vector<Fan> fans = around.fans;
        for (Fan& fan : fans) {
            while (fan.size() > 3) {
                if (!swap_cheapest(fan, around.closed)) return std::nullopt;
            }
        }
        if (!(around.closed ? close_hole(fans[0]) : join_sheets(fans))) return std::nullopt;
        plan_.lost_volume = lost_volume();
        for (const Neighbour& n : neighbours_) {
            if (n.free_distance < mesh_.free_distance(n.vertex))
                plan_.lowered.emplace_back(n.vertex, n.free_distance);
        }
        return std::move(plan_);
    }

  private:
    void collect_neighbours();
    [[nodiscard]] std::size_t place(std::uint32_t vertex) const {
        const auto found =
            std::lower_bound(neighbours_.begin(), neighbours_.end(), vertex,
                             [](const Neighbour& n, std::uint32_t key) { return n.vertex < key; });
        return static_cast<std::size_t>(found - neighbours_.begin());
    }
    [[nodiscard]] Neighbour& at(std::uint32_t vertex) { return neighbours_[place(vertex)]; }

    [[nodiscard]] bool swap_cheapest(Fan& fan, bool closed);
    [[nodiscard]] std::optional<Step> try_swap(std::uint32_t w, std::uint32_t x, std::uint32_t y);
    [[nodiscard]] bool close_hole(const Fan& ring);
    [[nodiscard]] bool join_sheets(const std::vector<Fan>& fans);
    [[nodiscard]] double lost_volume();

    const DynamicMesh& mesh_;
    std::uint32_t vertex_;
    Vec3d centre_;
    double free_distance_;
    std::vector<Neighbour> neighbours_;  // ascending
    Elimination plan_;
};

void Planner::collect_neighbours() {
    for (const std::uint32_t triangle : mesh_.star(vertex_)) {
        for (const std::uint32_t corner : mesh_.corners(triangle)) {
            if (corner != vertex_)
                neighbours_.push_back({corner, mesh_.position(corner), mesh_.free_distance(corner), 0.0});
        }
    }
    const auto before = [](const Neighbour& a, const Neighbour& b) { return a.vertex < b.vertex; };
    const auto same = [](const Neighbour& a, const Neighbour& b) { return a.vertex == b.vertex; };
    std::sort(neighbours_.begin(), neighbours_.end(), before);
    neighbours_.erase(std::unique(neighbours_.begin(), neighbours_.end(), same), neighbours_.end());
    for (Neighbour& n : neighbours_) {
        for (const std::uint32_t triangle : mesh_.star(n.vertex)) {
            const Corners& corners = mesh_.corners(triangle);
            if (std::find(corners.begin(), corners.end(), vertex_) == corners.end())
                n.outer_area += mesh_.area(corners);
        }
    }
}

// The edge from the vertex to x is replaced by the edge w-y.
std::optional<Step> Planner::try_swap(std::uint32_t w, std::uint32_t x, std::uint32_t y) {
    const Neighbour& nw = at(w);
    const Neighbour& nx = at(x);
    const Neighbour& ny = at(y);
    const auto nearest = crossing(centre_, nx.position, nw.position, ny.position);
    if (!nearest || is_flat(nw.position, nx.position, ny.position) || mesh_.is_edge(w, y))
        return std::nullopt;
    const double s = nearest->along_old;
    const double t = nearest->along_new;
    const double old_ball = (1.0 - s) * free_distance_ + s * nx.free_distance;
    const double excess =
        std::max(0.0, (1.0 - t) * nw.free_distance + t * ny.free_distance - (old_ball - nearest->distance));
    const double squares = (1.0 - t) * (1.0 - t) + t * t;
    const double rw = nw.free_distance - excess * (1.0 - t) / squares;
    const double ry = ny.free_distance - excess * t / squares;

    const auto area = [](const Vec3d& a, const Vec3d& b, const Vec3d& c) {
        return 0.5 * (b - a).cross(c - a).norm();
    };
    Step step;
    step.changes = {{{place(w), rw}, {place(y), ry}}};
    step.lost_volume =
        volume(area(centre_, nw.position, nx.position), free_distance_, nw.free_distance, nx.free_distance) +
        volume(area(centre_, nx.position, ny.position), free_distance_, nx.free_distance, ny.free_distance) -
        volume(area(centre_, nw.position, ny.position), free_distance_, rw, ry) -
        volume(area(nw.position, nx.position, ny.position), rw, nx.free_distance, ry) +
        volume(nw.outer_area, nw.free_distance, 0.0, 0.0) - volume(nw.outer_area, rw, 0.0, 0.0) +
        volume(ny.outer_area, ny.free_distance, 0.0, 0.0) - volume(ny.outer_area, ry, 0.0, 0.0);
    return step;
}

// Removes one vertex from the fan. The ends of an open fan stay.
bool Planner::swap_cheapest(Fan& fan, bool closed) {
    const std::size_t count = fan.size();
    const std::size_t open = closed ? 0 : 1;
    Step best;
    bool found = false;
    for (std::size_t i = open; i < count - open; ++i) {
        auto step = try_swap(fan[(i + count - 1) % count], fan[i], fan[(i + 1) % count]);
        if (!step || !(step->lost_volume < best.lost_volume)) continue;
        best = *step;
        best.position = i;
        found = true;
    }
    if (!found) return false;
    const std::size_t i = best.position;
    plan_.triangles.push_back({fan[(i + count - 1) % count], fan[i], fan[(i + 1) % count]});
    for (const Change& change : best.changes)
        neighbours_[change.neighbour].free_distance = change.free_distance;
    fan.erase(fan.begin() + static_cast<std::ptrdiff_t>(i));
    return true;
}

// Three triangles around the vertex become one.
bool Planner::close_hole(const Fan& ring) {
    const std::array<Neighbour*, 3> corners{&at(ring[0]), &at(ring[1]), &at(ring[2])};
    const bake::Triangle3d triangle{corners[0]->position, corners[1]->position, corners[2]->position};
    if (is_flat(triangle[0], triangle[1], triangle[2]) || mesh_.is_triangle(ring[0], ring[1], ring[2]))
        return false;
    const Vec3d nearest = bake::closest_point(triangle, centre_);
    const std::array<double, 3> weights = weights_of(triangle, nearest);
    double excess = (nearest - centre_).norm() - free_distance_;
    double squares = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
        excess += weights[i] * corners[i]->free_distance;
        squares += weights[i] * weights[i];
    }
    for (std::size_t i = 0; i < 3 && excess > 0.0; ++i)
        corners[i]->free_distance -= excess * weights[i] / squares;
    plan_.triangles.push_back({ring[0], ring[1], ring[2]});
    return true;
}

// Two triangles a sheet become one: the two seam edges become one.
bool Planner::join_sheets(const std::vector<Fan>& fans) {
    Neighbour& from = at(fans[0].front());
    Neighbour& to = at(fans[0].back());
    if (mesh_.is_edge(from.vertex, to.vertex)) return false;
    const Vec3d along = to.position - from.position;
    const double t = (centre_ - from.position).dot(along) / along.squaredNorm();
    if (!(t > margin && t < 1.0 - margin)) return false;
    const double distance = (from.position + t * along - centre_).norm();
    const double excess = (1.0 - t) * from.free_distance + t * to.free_distance - (free_distance_ - distance);
    if (excess > 0.0) {
        const double squares = (1.0 - t) * (1.0 - t) + t * t;
        from.free_distance -= excess * (1.0 - t) / squares;
        to.free_distance -= excess * t / squares;
    }
    for (const Fan& fan : fans) {
        if (is_flat(from.position, at(fan[1]).position, to.position)) return false;
        plan_.triangles.push_back({fan[0], fan[1], fan[2]});
    }
    return true;
}

// Old volume less new volume: of the star, and around it where free distances were lowered.
double Planner::lost_volume() {
    double lost = 0.0;
    for (const std::uint32_t triangle : mesh_.star(vertex_)) {
        const Corners& c = mesh_.corners(triangle);
        lost += volume(mesh_.area(c), mesh_.free_distance(c[0]), mesh_.free_distance(c[1]),
                       mesh_.free_distance(c[2]));
    }
    for (const Corners& c : plan_.triangles)
        lost -= volume(mesh_.area(c), at(c[0]).free_distance, at(c[1]).free_distance, at(c[2]).free_distance);
    for (const Neighbour& n : neighbours_) {
        lost += volume(n.outer_area, mesh_.free_distance(n.vertex), 0.0, 0.0) -
                volume(n.outer_area, n.free_distance, 0.0, 0.0);
    }
    return lost;
}

}  // namespace

std::optional<Elimination> plan_elimination(const DynamicMesh& mesh, std::uint32_t vertex, bool seams) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> link;
    for (const std::uint32_t triangle : mesh.star(vertex)) {
        const Corners& c = mesh.corners(triangle);
        const auto i = static_cast<std::size_t>(std::find(c.begin(), c.end(), vertex) - c.begin());
        link.emplace_back(c[(i + 1) % 3], c[(i + 2) % 3]);
    }
    const auto around = surroundings(link);
    if (!around || (!around->closed && !seams)) return std::nullopt;
    return Planner(mesh, vertex).plan(*around);
}

}  // namespace camdir::paper
