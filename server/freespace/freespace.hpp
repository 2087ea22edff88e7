// The Voronoi freespace representation (VFS-rep) of one map: the paper's section 4.2.
//
// The mesh V(S) approximates the medial surface of the free space. Every vertex carries a free distance
// d_f; the free distance of a point m of a triangle is interpolated linearly from its corners. The slab
// S_f(v) of a triangle is the union of the balls around all of its points m with radius d_f(m); points
// with d_f(m) <= 0 contribute nothing. Slabs never touch an obstacle.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/geometry.hpp"

namespace camdir::freespace {

inline constexpr std::uint32_t none = 0xffffffffU;

struct Vertex {
    float x, y, z;
    float free_distance;  // d_f; may be negative

    [[nodiscard]] Vec3f position() const { return {x, y, z}; }
};

// Indices of vertices.
struct Triangle {
    std::uint32_t a, b, c;
};

struct SpawnPoint {
    Vec3f eye;
    float yaw;  // radians
};

// One number of the bake's report, in the order of the stages: "sample", "points", 52310.
struct Count {
    std::string stage;
    std::string what;
    double value;
};

struct Metadata {
    std::string map_name;
    std::string source_name;
    std::uint64_t source_hash = 0;  // xxh3-64 of the source map's bytes
    float metres_per_unit = 1.0F;
    float d0 = 0.0F;         // sampling distance that was used, map units
    std::string parameters;  // the bake's parameters as a JSON object
    std::vector<Count>
        counts;  // the bake's report; seconds are not kept, so that equal input gives equal bytes
};

// What a bake makes and a file holds, in memory that the caller owns.
struct Contents {
    Metadata metadata;
    std::vector<Vertex> vertices;
    std::vector<Triangle> triangles;
    std::vector<SpawnPoint> spawn_points;
};

struct IndexNode;

// A coarse grid of what to try first at a point; queries check what it says.
struct HintGrid {
    Vec3f origin = Vec3f::Zero();
    float cell_size = 1.0F;
    std::array<std::uint32_t, 3> extent{};     // cells along x, y, z
    std::span<const std::uint32_t> triangles;  // x fastest: the best slab for the cell's centre, or none

    // The triangle of the point's cell; none outside the grid.
    [[nodiscard]] std::uint32_t at(const Vec3f& point) const {
        std::size_t cell = 0;
        for (int axis = 2; axis >= 0; --axis) {
            const float position = (point[axis] - origin[axis]) / cell_size;
            const std::uint32_t count = extent[static_cast<std::size_t>(axis)];
            if (!(position >= 0.0F && position < static_cast<float>(count))) return none;
            cell = cell * count + static_cast<std::uint32_t>(position);
        }
        return triangles[cell];
    }
};

// The mesh and what queries need beside it.
struct MeshView {
    std::span<const Vertex> vertices;
    std::span<const Triangle> triangles;
    std::span<const std::uint32_t> incident_offsets;    // one a vertex and one more
    std::span<const std::uint32_t> incident_triangles;  // of each vertex, ascending
    std::span<const IndexNode> index;                   // [0] is the root; empty without triangles
    HintGrid hints;
};

// Immutable; all const members are thread-safe. Cheap to copy: copies share the storage, which lives as long
// as one of them.
class Freespace {
  public:
    // Maps a MAP.vfs into memory and verifies it (magic, version, size, hash, bounds of every reference,
    // finite numbers). Errors name the file and what is wrong: damaged, truncated, or written by a newer
    // version.
    [[nodiscard]] static Result<Freespace> open(const std::filesystem::path& path);

    // The same from bytes in memory, which are kept. `name` stands for the path in errors.
    [[nodiscard]] static Result<Freespace> parse(std::vector<std::byte> bytes, const std::string& name);

    [[nodiscard]] const Metadata& metadata() const;
    [[nodiscard]] const Box3f& bounds() const;  // of the vertices
    [[nodiscard]] std::span<const SpawnPoint> spawn_points() const;
    // Bytes of the file that the representation was read from.
    [[nodiscard]] std::size_t byte_size() const;

    [[nodiscard]] std::span<const Vertex> vertices() const { return mesh_.vertices; }
    [[nodiscard]] std::span<const Triangle> triangles() const { return mesh_.triangles; }
    // Triangles that have `vertex` as a corner, ascending.
    [[nodiscard]] std::span<const std::uint32_t> incident(std::uint32_t vertex) const {
        const std::uint32_t first = mesh_.incident_offsets[vertex];
        return mesh_.incident_triangles.subspan(first, mesh_.incident_offsets[vertex + 1] - first);
    }
    [[nodiscard]] const MeshView& mesh() const { return mesh_; }

  private:
    struct Storage;
    explicit Freespace(std::shared_ptr<const Storage> storage);
    static Result<Freespace> read(std::shared_ptr<Storage> storage, const std::string& name);

    std::shared_ptr<const Storage> storage_;
    MeshView mesh_;  // into storage_
};

// The bytes of a MAP.vfs: adds hints and hash, and puts triangles and vertices in the order of the query
// index, so that what is near in space is near in memory. The same contents give the same bytes.
// Preconditions (asserted): fewer than 2^28 triangles, indices in range, three different corners a triangle,
// finite numbers within +-coordinate_limit.
[[nodiscard]] std::vector<std::byte> encode(const Contents& contents);

// Coordinates and free distances of a file are within +- this, so that no query overflows.
inline constexpr float coordinate_limit = 1e8F;

}  // namespace camdir::freespace
