#include "freespace/check.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "freespace/index.hpp"
#include "support/freespace_meshes.hpp"

namespace camdir::freespace {
namespace {

using testing::HasSubstr;

// A valid mesh in memory of its own, to be broken.
struct Mesh {
    std::vector<Vertex> vertices;
    std::vector<Triangle> triangles;
    std::vector<std::uint32_t> incident_offsets;
    std::vector<std::uint32_t> incident_triangles;
    std::vector<IndexNode> index;
    HintGrid hints;
    std::vector<std::uint32_t> hint_triangles;

    Mesh() {
        std::mt19937 random(9);
        const Freespace freespace = test::make_freespace(test::random_contents(random, 12, 9, 0));
        const MeshView& mesh = freespace.mesh();
        vertices.assign(mesh.vertices.begin(), mesh.vertices.end());
        triangles.assign(mesh.triangles.begin(), mesh.triangles.end());
        incident_offsets.assign(mesh.incident_offsets.begin(), mesh.incident_offsets.end());
        incident_triangles.assign(mesh.incident_triangles.begin(), mesh.incident_triangles.end());
        index.assign(mesh.index.begin(), mesh.index.end());
        hints = mesh.hints;
        hint_triangles.assign(hints.triangles.begin(), hints.triangles.end());
    }
    [[nodiscard]] std::string flaw() const {
        HintGrid grid = hints;
        grid.triangles = hint_triangles;
        return find_flaw({vertices, triangles, incident_offsets, incident_triangles, index, grid});
    }
};

class CheckTest : public testing::Test {
  protected:
    void SetUp() override { ASSERT_EQ(mesh.flaw(), ""); }
    Mesh mesh;
};

TEST_F(CheckTest, NumbersThatAreNotFiniteOrTooLarge) {
    for (const float bad : {NAN, INFINITY, -INFINITY, 2.0F * coordinate_limit}) {
        Mesh broken = mesh;
        broken.vertices[5].y = bad;
        EXPECT_EQ(broken.flaw(), "vertex 5 is not finite or out of range");
        broken = mesh;
        broken.vertices[7].free_distance = bad;
        EXPECT_EQ(broken.flaw(), "vertex 7 is not finite or out of range");
    }
}

TEST_F(CheckTest, Triangles) {
    Mesh broken = mesh;
    broken.triangles[3].c = static_cast<std::uint32_t>(mesh.vertices.size());
    EXPECT_EQ(broken.flaw(), "triangle 3 has a corner that does not exist");
    broken = mesh;
    broken.triangles[3].c = broken.triangles[3].a;
    EXPECT_EQ(broken.flaw(), "triangle 3 has a corner twice");
}

TEST_F(CheckTest, Incidence) {
    Mesh broken = mesh;
    broken.incident_offsets.pop_back();
    EXPECT_THAT(broken.flaw(), HasSubstr("the incidence's size"));
    broken = mesh;
    broken.incident_triangles.push_back(0);
    EXPECT_THAT(broken.flaw(), HasSubstr("the incidence's size"));
    broken = mesh;
    broken.incident_offsets[4] = broken.incident_offsets.back() + 1;
    EXPECT_THAT(broken.flaw(), HasSubstr("out of range"));
    broken = mesh;
    broken.incident_triangles[8] = static_cast<std::uint32_t>(mesh.triangles.size());
    EXPECT_THAT(broken.flaw(), HasSubstr("do not exist"));
    broken = mesh;
    const auto shared = std::ranges::adjacent_find(
        mesh.incident_offsets, [](std::uint32_t first, std::uint32_t end) { return end - first >= 2; });
    std::swap(broken.incident_triangles[*shared], broken.incident_triangles[*shared + 1]);
    EXPECT_THAT(broken.flaw(), HasSubstr("out of order"));
    broken = mesh;
    broken.triangles[0] = broken.triangles[100];
    EXPECT_THAT(broken.flaw(), HasSubstr("the incidence is not that of the triangles"));
}

TEST_F(CheckTest, Index) {
    Mesh broken = mesh;
    broken.index.clear();
    EXPECT_THAT(broken.flaw(), HasSubstr("the index's size"));
    broken = mesh;
    broken.index[1].child[0] = IndexChild::node(0).bits();
    EXPECT_EQ(broken.flaw(), "index node 1 has a child out of order") << "a loop";
    broken = mesh;
    broken.index[0].child[1] = broken.index[0].child[0];
    EXPECT_EQ(broken.flaw(), "index node 0 has a child out of order") << "shared";
    broken = mesh;
    broken.index[0].child[3] = IndexChild::node(static_cast<std::uint32_t>(mesh.index.size())).bits();
    EXPECT_THAT(broken.flaw(), HasSubstr("child out of order"));
    broken = mesh;
    broken.index.push_back(broken.index.back());
    EXPECT_THAT(broken.flaw(), HasSubstr("index node"));
    broken = mesh;
    broken.index.back().child[0] = IndexChild::leaf(0, 7).bits();
    EXPECT_THAT(broken.flaw(), HasSubstr("leaf out of order"));
    broken = mesh;
    broken.index.back().child[3] = IndexChild::leaf(0, 0).bits();
    EXPECT_EQ(broken.flaw(), "the index does not hold every triangle");
}

TEST_F(CheckTest, Hints) {
    Mesh broken = mesh;
    ++broken.hints.extent[2];
    EXPECT_EQ(broken.flaw(), "the grid of hints does not fit its size");
    broken = mesh;
    broken.hints.extent = {1U << 31U, 1U << 31U, 4};
    EXPECT_EQ(broken.flaw(), "the grid of hints is too large");
    for (const float bad : {0.0F, -1.0F, NAN, INFINITY}) {
        broken = mesh;
        broken.hints.cell_size = bad;
        EXPECT_EQ(broken.flaw(), "the grid of hints does not fit its size");
    }
    broken = mesh;
    broken.hint_triangles[3] = static_cast<std::uint32_t>(mesh.triangles.size());
    EXPECT_EQ(broken.flaw(), "hint 3 is a triangle that does not exist");
}

TEST(Check, IndexThatIsTooDeepForTheQueries) {
    // A chain: each node holds the next one and one triangle.
    Mesh mesh;
    const std::uint32_t length = index_depth_limit + 1;
    mesh.vertices = {{0, 0, 0, 1}, {1, 0, 0, 1}, {0, 1, 0, 1}};
    mesh.triangles.assign(length, {0, 1, 2});
    mesh.incident_offsets = {0, length, 2 * length, 3 * length};
    mesh.incident_triangles.clear();
    mesh.hint_triangles.assign(mesh.hint_triangles.size(), none);
    for (std::uint32_t i = 0; i < 3 * length; ++i)
        mesh.incident_triangles.push_back(i % length);
    const auto chain = [&](std::uint32_t nodes) {
        mesh.index.assign(nodes, IndexNode{});
        for (std::uint32_t i = 0; i < nodes; ++i) {
            const std::uint32_t nothing = IndexChild::leaf(0, 0).bits();
            const std::uint32_t next = i + 1 < nodes ? IndexChild::node(i + 1).bits() : nothing;
            const std::uint32_t count = i + 1 < nodes ? 1 : length - i;
            std::ranges::copy(std::array{next, IndexChild::leaf(i, count).bits(), nothing, nothing},
                              mesh.index[i].child);
        }
        return mesh.flaw();
    };
    EXPECT_EQ(chain(index_depth_limit), "");
    EXPECT_EQ(chain(index_depth_limit + 1), "the index is too deep");
}

}  // namespace
}  // namespace camdir::freespace
