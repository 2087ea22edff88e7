// The Voronoi freespace representation (VFS-rep) of one map: the paper's section 4.2.
//
// The mesh V(S) approximates the medial surface of the free space. Every vertex carries a free distance
// d_f; the free distance of a point m of a triangle is interpolated linearly from its corners. The slab
// S_f(v) of a triangle is the union of the balls around all of its points m with radius d_f(m); points
// with d_f(m) <= 0 contribute nothing. Slabs never touch an obstacle.
#pragma once

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

// Immutable; all const members are thread-safe. Cheap to copy: copies share the storage.
class Freespace {
  public:
    // Maps a MAP.vfs into memory and verifies it (magic, version, bounds of every reference, finite numbers,
    // hash). Errors name the file and what is wrong: damaged, truncated, or written by a newer version.
    [[nodiscard]] static Result<Freespace> open(const std::filesystem::path& path);

    // The same from bytes in memory, which are kept. `name` stands for the path in errors.
    [[nodiscard]] static Result<Freespace> parse(std::vector<std::byte> bytes, const std::string& name);

    [[nodiscard]] const Metadata& metadata() const;
    [[nodiscard]] const Box3f& bounds() const;  // of the vertices
    [[nodiscard]] std::span<const Vertex> vertices() const;
    [[nodiscard]] std::span<const Triangle> triangles() const;
    [[nodiscard]] std::span<const SpawnPoint> spawn_points() const;
    // Triangles that have `vertex` as a corner, ascending.
    [[nodiscard]] std::span<const std::uint32_t> incident(std::uint32_t vertex) const;
    [[nodiscard]] std::span<const IndexNode> index() const;
    // Bytes of the file that the representation was read from.
    [[nodiscard]] std::size_t byte_size() const;

  private:
    struct Storage;
    explicit Freespace(std::shared_ptr<const Storage> storage) : storage_(std::move(storage)) {}
    std::shared_ptr<const Storage> storage_;
};

// The bytes of a MAP.vfs: adds incidence, query index and hash. The same contents give the same bytes.
// Preconditions (asserted): indices in range, finite numbers.
[[nodiscard]] std::vector<std::byte> encode(const Contents& contents);

}  // namespace camdir::freespace
