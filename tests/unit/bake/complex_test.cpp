#include "bake/reduction/complex.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <set>

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

struct Shape {
    std::int64_t euler;
    std::size_t components;
    bool operator==(const Shape&) const = default;
};

Shape shape_of(const std::vector<freespace::Triangle>& triangles) {
    std::set<std::uint32_t> vertices;
    std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (const freespace::Triangle& t : triangles) {
        for (const auto& [a, b] : {std::pair(t.a, t.b), std::pair(t.b, t.c), std::pair(t.c, t.a)}) {
            vertices.insert(a);
            edges.insert(std::minmax(a, b));
        }
    }
    std::set<std::uint32_t> rest = vertices;
    std::size_t components = 0;
    while (!rest.empty()) {
        ++components;
        std::vector<std::uint32_t> open{*rest.begin()};
        rest.erase(rest.begin());
        while (!open.empty()) {
            const std::uint32_t at = open.back();
            open.pop_back();
            for (const auto& [a, b] : edges) {
                for (const std::uint32_t far : {a == at ? b : at, b == at ? a : at}) {
                    if (rest.erase(far) > 0) open.push_back(far);
                }
            }
        }
    }
    return {static_cast<std::int64_t>(vertices.size()) - static_cast<std::int64_t>(edges.size()) +
                static_cast<std::int64_t>(triangles.size()),
            components};
}

// Collapses drawn edges until none may go.
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
    // Two triangles at the edge 1-2: merging 0 into 1 would leave 1-2 to the other alone, which is fine;
    // of the strip 0-1-2 and 1-2-3, 3-4 hangs on one triangle.
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

TEST(Complex, CollapsesKeepHolesBranchesAndParts) {
    for (unsigned seed = 1; seed <= 20; ++seed) {
        SCOPED_TRACE(seed);
        for (const MedialMesh& mesh :
             {grid(6, 5), ring_with_fins(8, 0), ring_with_fins(9, 2), ring_with_fins(7, 3)}) {
            Complex complex(mesh);
            const Shape before = shape_of(mesh.triangles);
            EXPECT_GT(collapse_all(complex, mesh.vertices.size(), seed), 0U);
            EXPECT_EQ(shape_of(complex.triangles()), before);
            EXPECT_EQ(complex.triangles().size(), complex.triangle_count());
        }
    }
}

}  // namespace
}  // namespace camdir::bake
