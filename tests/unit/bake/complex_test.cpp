#include "bake/reduction/complex.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <map>
#include <numeric>
#include <random>
#include <set>

#include "base/disjoint_sets.hpp"

namespace camdir::bake {
namespace {

MedialMesh mesh_of(std::size_t vertex_count, std::vector<freespace::Triangle> triangles) {
    MedialMesh mesh;
    mesh.vertices.resize(vertex_count, Vec3f::Zero());
    mesh.triangles = std::move(triangles);
    return mesh;
}

// width x height squares of two triangles each.
MedialMesh grid(std::uint32_t width, std::uint32_t height) {
    std::vector<freespace::Triangle> triangles;
    for (std::uint32_t y = 0; y < height; ++y) {
        for (std::uint32_t x = 0; x < width; ++x) {
            const std::uint32_t a = y * (width + 1) + x;
            const std::uint32_t b = a + width + 1;
            triangles.push_back({a, a + 1, b});
            triangles.push_back({a + 1, b + 1, b});
        }
    }
    return mesh_of((width + 1) * (height + 1), std::move(triangles));
}

// A ring of quads around an axis, with `pages` more grids standing on one of its circles: not a manifold.
MedialMesh ring_with_fins(std::uint32_t around, std::uint32_t pages) {
    std::vector<freespace::Triangle> triangles;
    const std::uint32_t strips = 2 + pages;
    for (std::uint32_t strip = 1; strip < strips; ++strip) {
        for (std::uint32_t i = 0; i < around; ++i) {
            const std::uint32_t next = (i + 1) % around;
            const std::uint32_t top = strip * around;
            triangles.push_back({i, next, top + i});
            triangles.push_back({next, top + next, top + i});
        }
    }
    return mesh_of(strips * around, std::move(triangles));
}

// Rank over GF(2); each column is a set of rows, as bits.
std::size_t rank_of(std::vector<std::uint64_t> columns) {
    std::size_t rank = 0;
    for (std::size_t i = 0; i < columns.size(); ++i) {
        if (columns[i] == 0) continue;
        ++rank;
        const std::uint64_t pivot = columns[i] & (~columns[i] + 1);
        for (std::size_t k = i + 1; k < columns.size(); ++k)
            if ((columns[k] & pivot) != 0) columns[k] ^= columns[i];
    }
    return rank;
}

// Numbers of components, holes and cavities: homology over GF(2). At most 64 vertices and edges.
using Betti = std::array<std::size_t, 3>;

Betti betti_of(const std::vector<freespace::Triangle>& triangles) {
    std::map<std::uint32_t, std::size_t> vertices;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> edges;
    std::vector<std::uint64_t> edge_columns;
    std::vector<std::uint64_t> triangle_columns;
    const auto bit = [](std::size_t i) {
        assert(i < 64);
        return std::uint64_t{1} << i;
    };
    for (const auto& [a, b, c] : triangles) {
        std::uint64_t column = 0;
        for (const auto& [p, q] : {std::pair(a, b), std::pair(b, c), std::pair(a, c)}) {
            const auto [edge, is_new] =
                edges.emplace(std::pair(std::min(p, q), std::max(p, q)), edges.size());
            column |= bit(edge->second);
            if (!is_new) continue;
            const std::size_t from = vertices.emplace(p, vertices.size()).first->second;
            const std::size_t to = vertices.emplace(q, vertices.size()).first->second;
            edge_columns.push_back(bit(from) | bit(to));
        }
        triangle_columns.push_back(column);
    }
    const std::size_t edge_rank = rank_of(edge_columns);
    const std::size_t triangle_rank = rank_of(triangle_columns);
    return {vertices.size() - edge_rank, edges.size() - edge_rank - triangle_rank,
            triangles.size() - triangle_rank};
}

// Different triangles over eight vertices: fins, pinched vertices, holes and cavities of every kind.
MedialMesh random_complex(std::mt19937& random) {
    constexpr std::uint32_t vertices = 8;
    std::vector<freespace::Triangle> all;
    for (std::uint32_t a = 0; a < vertices; ++a)
        for (std::uint32_t b = a + 1; b < vertices; ++b)
            for (std::uint32_t c = b + 1; c < vertices; ++c)
                all.push_back({a, b, c});
    std::shuffle(all.begin(), all.end(), random);
    all.resize(std::uniform_int_distribution<std::size_t>(2, 24)(random));
    return mesh_of(vertices, all);
}

// Vertices, edges and triangles with alternating signs, and the number of components.
struct Shape {
    std::int64_t euler;
    std::size_t components;
    bool operator==(const Shape&) const = default;
};

Shape shape_of(const std::vector<freespace::Triangle>& triangles, std::size_t vertex_count) {
    std::set<std::uint32_t> vertices;
    std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
    DisjointSets sets(vertex_count);
    for (const freespace::Triangle& t : triangles) {
        for (const auto& [a, b] : {std::pair(t.a, t.b), std::pair(t.b, t.c), std::pair(t.c, t.a)}) {
            vertices.insert(a);
            edges.insert(std::minmax(a, b));
            sets.unite(a, b);
        }
    }
    std::set<std::uint32_t> components;
    for (const std::uint32_t vertex : vertices)
        components.insert(sets.find(vertex));
    return {static_cast<std::int64_t>(vertices.size()) - static_cast<std::int64_t>(edges.size()) +
                static_cast<std::int64_t>(triangles.size()),
            components.size()};
}

// Collapses random edges until no collapse is allowed.
std::size_t collapse_all(Complex& complex, std::size_t vertex_count, unsigned seed) {
    std::mt19937 random(seed);
    std::vector<std::uint32_t> order(vertex_count);
    std::iota(order.begin(), order.end(), 0U);
    std::size_t collapses = 0;
    for (bool changed = true; changed;) {
        changed = false;
        std::shuffle(order.begin(), order.end(), random);
        std::vector<std::uint32_t> neighbours;
        for (const std::uint32_t from : order) {
            complex.neighbours(from, neighbours);
            std::shuffle(neighbours.begin(), neighbours.end(), random);
            for (const std::uint32_t to : neighbours) {
                if (!complex.can_collapse(from, to)) continue;
                complex.collapse(from, to);
                changed = true;
                ++collapses;
                break;
            }
        }
    }
    return collapses;
}

TEST(Complex, CollapseMovesTheTrianglesAndDropsThoseAtTheEdge) {
    Complex complex(grid(3, 3));
    ASSERT_TRUE(complex.can_collapse(5, 6));
    complex.collapse(5, 6);
    EXPECT_EQ(complex.triangle_count(), 16U);
    EXPECT_TRUE(complex.star(5).empty());
    for (const freespace::Triangle& t : complex.triangles()) {
        EXPECT_TRUE(t.a != 5 && t.b != 5 && t.c != 5);
        EXPECT_TRUE(t.a != t.b && t.b != t.c && t.c != t.a);
    }
}

TEST(Complex, ASingleTriangleStays) {
    const Complex complex(mesh_of(3, {{0, 1, 2}}));
    EXPECT_FALSE(complex.can_collapse(0, 1));
}

TEST(Complex, NoEdgeIsLeftWithoutATriangle) {
    // A strip. Merging 0 into 1 leaves the edge 1-2 with the triangle 1-2-3; merging 2 into 1 takes the only
    // triangle of 0-1.
    const Complex complex(mesh_of(5, {{0, 1, 2}, {1, 2, 3}, {2, 3, 4}}));
    EXPECT_TRUE(complex.can_collapse(0, 1));
    EXPECT_FALSE(complex.can_collapse(2, 1)) << "0-1 would have no triangle";
}

TEST(Complex, AClosedSurfaceStaysClosed) {
    const Complex tetrahedron(mesh_of(4, {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}}));
    for (std::uint32_t from = 0; from < 4; ++from) {
        for (std::uint32_t to = 0; to < 4; ++to) {
            if (from == to) continue;
            EXPECT_FALSE(tetrahedron.can_collapse(from, to));
        }
    }
}

TEST(Complex, CollapsesKeepComponentsAndEulerCharacteristic) {
    for (unsigned seed = 1; seed <= 20; ++seed) {
        SCOPED_TRACE(seed);
        for (const MedialMesh& mesh :
             {grid(6, 5), ring_with_fins(8, 0), ring_with_fins(9, 2), ring_with_fins(7, 3)}) {
            Complex complex(mesh);
            const Shape before = shape_of(mesh.triangles, mesh.vertices.size());
            EXPECT_GT(collapse_all(complex, mesh.vertices.size(), seed), 0U);
            EXPECT_EQ(shape_of(complex.triangles(), mesh.vertices.size()), before);
            EXPECT_EQ(complex.triangles().size(), complex.triangle_count());
        }
    }
}

TEST(Complex, EveryCollapseKeepsTheHomology) {
    std::mt19937 random(9);
    int collapses = 0;
    std::set<Betti> seen;
    for (int round = 0; round < 500; ++round) {
        const MedialMesh mesh = random_complex(random);
        const Betti before = betti_of(mesh.triangles);
        seen.insert(before);
        for (std::uint32_t from = 0; from < mesh.vertices.size(); ++from) {
            for (std::uint32_t to = 0; to < mesh.vertices.size(); ++to) {
                Complex complex(mesh);
                std::vector<std::uint32_t> neighbours;
                complex.neighbours(from, neighbours);
                if (!std::binary_search(neighbours.begin(), neighbours.end(), to)) continue;
                if (!complex.can_collapse(from, to)) continue;
                complex.collapse(from, to);
                ASSERT_EQ(betti_of(complex.triangles()), before)
                    << "round " << round << ": " << from << " into " << to;
                ++collapses;
            }
        }
    }
    EXPECT_GT(collapses, 500);
    EXPECT_GT(seen.size(), 10U) << "complexes of many kinds";
}

}  // namespace
}  // namespace camdir::bake
