#include "bench/paper/vertex_elimination.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <random>
#include <set>

#include "bake/geometry/certificate.hpp"

namespace camdir::paper {
namespace {

using bake::MedialMesh;
using bake::Slab;

constexpr double everything = std::numeric_limits<double>::infinity();

// Sheets of (size + 1) x (size + 1) vertices that share their first column.
struct Sheets {
    MedialMesh mesh;
    std::vector<float> free_distance;
    std::vector<std::uint32_t> interior;  // off the border of their sheet
    std::vector<std::uint32_t> seam;      // on the first column but not at its ends
};

Sheets sheets(std::uint32_t size, int count) {
    Sheets result;
    std::map<std::array<int, 3>, std::uint32_t> ids;
    const auto vertex = [&](int sheet, std::uint32_t i, std::uint32_t j) {
        const std::array<int, 3> key{i == 0 ? 0 : sheet, static_cast<int>(i), static_cast<int>(j)};
        const auto [place, is_new] = ids.try_emplace(key, static_cast<std::uint32_t>(ids.size()));
        if (is_new) {
            const double angle = 2.0 * M_PI * sheet / count;
            result.mesh.vertices.emplace_back(static_cast<float>(i * std::cos(angle)),
                                              static_cast<float>(i * std::sin(angle)), static_cast<float>(j));
            result.free_distance.push_back(5.0F);
            const bool inside = j > 0 && j < size;
            if (inside && i > 0 && i < size) result.interior.push_back(place->second);
            if (inside && i == 0) result.seam.push_back(place->second);
        }
        return place->second;
    };
    for (int sheet = 0; sheet < count; ++sheet) {
        for (std::uint32_t i = 0; i < size; ++i) {
            for (std::uint32_t j = 0; j < size; ++j) {
                const auto a = vertex(sheet, i, j);
                const auto b = vertex(sheet, i + 1, j);
                const auto c = vertex(sheet, i + 1, j + 1);
                const auto d = vertex(sheet, i, j + 1);
                result.mesh.triangles.push_back({a, b, c});
                result.mesh.triangles.push_back({a, c, d});
            }
        }
    }
    return result;
}

std::set<std::uint32_t> used(const MedialMesh& mesh) {
    std::set<std::uint32_t> vertices;
    for (const auto& [a, b, c] : mesh.triangles)
        vertices.insert({a, b, c});
    return vertices;
}

double area(const MedialMesh& mesh) {
    double sum = 0.0;
    for (const freespace::Triangle& t : mesh.triangles) {
        const auto c = mesh.corners(t);
        sum += 0.5 * (c[1] - c[0]).cross(c[2] - c[0]).norm();
    }
    return sum;
}

std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges(const MedialMesh& mesh) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> count;
    for (const auto& [a, b, c] : mesh.triangles) {
        ++count[std::minmax(a, b)];
        ++count[std::minmax(b, c)];
        ++count[std::minmax(c, a)];
    }
    return count;
}

Slab slab_of(const MedialMesh& mesh, const std::vector<float>& r, const freespace::Triangle& t) {
    return {mesh.corners(t), {r[t.a], r[t.b], r[t.c]}};
}

// Every ball of the new mesh lies in a ball of the old one.
void expect_inside(const MedialMesh& mesh, const std::vector<float>& r, const MedialMesh& old,
                   const std::vector<float>& old_r) {
    std::vector<Slab> slabs;
    for (const freespace::Triangle& t : old.triangles)
        slabs.push_back(slab_of(old, old_r, t));
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (const freespace::Triangle& t : mesh.triangles) {
        for (int i = 0; i < 10; ++i) {
            const double u = unit(random);
            const double v = unit(random) * (1.0 - u);
            const auto c = mesh.corners(t);
            const Vec3d m = (1.0 - u - v) * c[0] + u * c[1] + v * c[2];
            const double radius = (1.0 - u - v) * r[t.a] + u * r[t.b] + v * r[t.c];
            double best = -everything;
            for (const Slab& slab : slabs)
                best = std::max(best, slab.distance(m));
            ASSERT_LE(radius, best + 1e-5);
        }
    }
}

TEST(VertexElimination, FlatGridIsReducedToItsBorder) {
    Sheets flat = sheets(12, 1);
    const MedialMesh old = flat.mesh;
    eliminate_vertices(flat.mesh, flat.free_distance, 1e-3);
    EXPECT_EQ(used(flat.mesh).size(), 4U * 12U);
    EXPECT_EQ(flat.mesh.triangles.size(), 4U * 12U - 2U);  // of a polygon with that many corners
    EXPECT_NEAR(area(flat.mesh), area(old), 1e-3);
    for (const std::uint32_t vertex : used(flat.mesh))
        EXPECT_NEAR(flat.free_distance[vertex], 5.0F, 1e-4F);
}

TEST(VertexElimination, ThresholdKeepsExpensiveVertices) {
    Sheets grid = sheets(12, 1);
    const std::uint32_t middle = grid.interior[grid.interior.size() / 2];
    grid.free_distance[middle] = 6.0F;
    Sheets all = grid;
    eliminate_vertices(grid.mesh, grid.free_distance, 0.1);
    EXPECT_TRUE(used(grid.mesh).contains(middle));
    EXPECT_EQ(grid.free_distance[middle], 6.0F);
    EXPECT_LT(used(grid.mesh).size(), 80U);  // of 169
    eliminate_vertices(all.mesh, all.free_distance, everything);
    EXPECT_FALSE(used(all.mesh).contains(middle));
}

TEST(VertexElimination, RemovesSeamVerticesAtTheEnd) {
    Sheets star = sheets(8, 3);
    const MedialMesh old = star.mesh;
    eliminate_vertices(star.mesh, star.free_distance, 1e-3);
    const auto left = used(star.mesh);
    for (const std::uint32_t vertex : star.interior)
        EXPECT_FALSE(left.contains(vertex));
    for (const std::uint32_t vertex : star.seam)
        EXPECT_FALSE(left.contains(vertex));
    EXPECT_EQ(left.size(), 3U * 3U * 8U - 3U + 2U);  // three sides a sheet, and the seam's ends once
    EXPECT_NEAR(area(star.mesh), area(old), 1e-3);
}

class BumpySheets : public testing::TestWithParam<int> {};

TEST_P(BumpySheets, NewFreespaceLiesInTheOldOne) {
    const int seed = GetParam();
    const int sheet_count = seed % 2 == 0 ? 1 : 3;
    Sheets bumpy = sheets(7, sheet_count);
    std::mt19937 random(static_cast<unsigned>(seed));
    std::uniform_real_distribution<float> shift(-0.3F, 0.3F);
    for (Vec3f& position : bumpy.mesh.vertices)
        position += Vec3f(shift(random), shift(random), shift(random));
    for (float& r : bumpy.free_distance)
        r += 5.0F * shift(random);
    const MedialMesh old = bumpy.mesh;
    const std::vector<float> old_r = bumpy.free_distance;
    eliminate_vertices(bumpy.mesh, bumpy.free_distance, seed % 3 == 0 ? everything : 5.0);
    EXPECT_LT(bumpy.mesh.triangles.size(), old.triangles.size());
    expect_inside(bumpy.mesh, bumpy.free_distance, old, old_r);

    // The border stays as it was, and edges keep one or two triangles, three only where they had three.
    auto left = edges(bumpy.mesh);
    for (const auto& [edge, count] : edges(old)) {
        if (count == 1) {
            EXPECT_EQ(left[edge], 1);
        }
    }
    for (const auto& [edge, count] : left)
        EXPECT_LE(count, sheet_count == 3 ? 3 : 2);
}

INSTANTIATE_TEST_SUITE_P(Seeds, BumpySheets, testing::Range(1, 9));

// An octahedron cannot lose a vertex and stay closed, whatever the order: down to a tetrahedron at most.
TEST(VertexElimination, ClosedSurfaceStaysClosed) {
    MedialMesh mesh;
    mesh.vertices = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    for (const std::uint32_t top : {4U, 5U})
        for (const auto& [a, b] : {std::pair{0U, 2U}, {2U, 1U}, {1U, 3U}, {3U, 0U}})
            mesh.triangles.push_back({a, b, top});
    std::vector<float> r(6, 10.0F);
    const MedialMesh old = mesh;
    eliminate_vertices(mesh, r, everything);
    EXPECT_LT(mesh.triangles.size(), 8U);
    EXPECT_GE(mesh.triangles.size(), 4U);
    for (const auto& [edge, count] : edges(mesh))
        EXPECT_EQ(count, 2);
    expect_inside(mesh, r, old, std::vector<float>(6, 10.0F));
}

}  // namespace
}  // namespace camdir::paper
