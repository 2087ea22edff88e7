#include "bake/reduction/complex.hpp"

#include <algorithm>

namespace camdir::bake {
namespace {

bool has(const Complex::Corners& corners, std::uint32_t vertex) {
    return corners[0] == vertex || corners[1] == vertex || corners[2] == vertex;
}

}  // namespace

Complex::Complex(const MedialMesh& mesh) : gone_(mesh.triangles.size(), 0), stars_(mesh.vertices.size()) {
    triangles_.reserve(mesh.triangles.size());
    for (const freespace::Triangle& t : mesh.triangles) {
        const auto id = static_cast<std::uint32_t>(triangles_.size());
        triangles_.push_back({t.a, t.b, t.c});
        for (const std::uint32_t corner : triangles_.back())
            stars_[corner].push_back(id);
    }
}

bool Complex::contains(std::uint32_t triangle, std::uint32_t vertex) const {
    return has(triangles_[triangle], vertex);
}

void Complex::neighbours(std::uint32_t vertex, std::vector<std::uint32_t>& neighbours) const {
    neighbours.clear();
    for (const std::uint32_t triangle : stars_[vertex]) {
        for (const std::uint32_t corner : triangles_[triangle]) {
            if (corner != vertex) neighbours.push_back(corner);
        }
    }
    std::sort(neighbours.begin(), neighbours.end());
    neighbours.erase(std::unique(neighbours.begin(), neighbours.end()), neighbours.end());
}

std::uint32_t Complex::opposite(std::uint32_t triangle, std::uint32_t a, std::uint32_t b) const {
    for (const std::uint32_t corner : triangles_[triangle]) {
        if (corner != a && corner != b) return corner;
    }
    return freespace::none;
}

std::size_t Complex::triangles_at_edge(std::uint32_t a, std::uint32_t b) const {
    return static_cast<std::size_t>(
        std::count_if(stars_[a].begin(), stars_[a].end(), [&](std::uint32_t t) { return contains(t, b); }));
}

bool Complex::is_edge(std::uint32_t a, std::uint32_t b) const {
    return std::any_of(stars_[a].begin(), stars_[a].end(), [&](std::uint32_t t) { return contains(t, b); });
}

bool Complex::can_collapse(std::uint32_t from, std::uint32_t to) const {
    bool keeps_something = stars_[to].size() > triangles_at_edge(to, from);
    for (const std::uint32_t triangle : stars_[from]) {
        if (contains(triangle, to)) {
            // The edge from the third corner to `to` needs another triangle, from either side.
            const std::uint32_t third = opposite(triangle, from, to);
            if (triangles_at_edge(third, from) + triangles_at_edge(third, to) < 3) return false;
            continue;
        }
        keeps_something = true;
        std::array<std::uint32_t, 2> far{};
        std::size_t count = 0;
        for (const std::uint32_t corner : triangles_[triangle]) {
            if (corner != from) far[count++] = corner;
        }
        // A common neighbour must be one through a triangle at their edge, and no edge may be opposite to
        // both: it would get two equal triangles.
        for (const std::uint32_t corner : far) {
            if (!is_edge(corner, to)) continue;
            const bool at_edge = std::any_of(stars_[from].begin(), stars_[from].end(), [&](std::uint32_t t) {
                return contains(t, to) && contains(t, corner);
            });
            if (!at_edge) return false;
        }
        const bool twin = std::any_of(stars_[to].begin(), stars_[to].end(), [&](std::uint32_t t) {
            return contains(t, far[0]) && contains(t, far[1]);
        });
        if (twin) return false;
    }
    return keeps_something;
}

void Complex::collapse(std::uint32_t from, std::uint32_t to) {
    for (const std::uint32_t triangle : stars_[from]) {
        Corners& corners = triangles_[triangle];
        if (has(corners, to)) {
            gone_[triangle] = 1;
            for (const std::uint32_t corner : corners) {
                if (corner != from) std::erase(stars_[corner], triangle);
            }
        } else {
            *std::find(corners.begin(), corners.end(), from) = to;
            stars_[to].push_back(triangle);
        }
    }
    stars_[from].clear();
}

std::size_t Complex::triangle_count() const {
    return static_cast<std::size_t>(std::count(gone_.begin(), gone_.end(), 0));
}

std::vector<freespace::Triangle> Complex::triangles() const {
    std::vector<freespace::Triangle> left;
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
        if (gone_[i] == 0) left.push_back({triangles_[i][0], triangles_[i][1], triangles_[i][2]});
    }
    return left;
}

}  // namespace camdir::bake
