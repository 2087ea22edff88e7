// The Voronoi freespace representation (VFS-rep) of one map: the paper's section 4.2.
//
// The mesh V(S) approximates the medial surface of the free space. Every vertex carries a free distance
// d_f; the free distance of a point m of a triangle is interpolated linearly from its corners. The slab
// S_f(v) of a triangle is the union of the balls around all of its points m with radius d_f(m); points
// with d_f(m) <= 0 contribute nothing. Slabs never touch an obstacle: the bake certifies it.
//
// The queries are distance.hpp (free distance of a point), visibility.hpp (free segments) and roadmap.hpp
// (shortest paths). Coordinates are right-handed with z up; lengths are in map units.
//
// No threads, no logging, no global state; headers need Eigen alone. Compiles with GCC and Clang, whose
// vector extensions the queries use.
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
#include "freespace/mover_shape.hpp"

namespace camdir::freespace {

// No vertex, no triangle.
inline constexpr std::uint32_t none = 0xffffffffU;

// Coordinates and free distances of a file are within +- this, so that no query overflows.
inline constexpr float coordinate_limit = 1e8F;

struct Vertex {
    float x, y, z;
    float free_distance;  // d_f; may be negative

    [[nodiscard]] Vec3f position() const { return {x, y, z}; }
};

// Three different vertices, by index; their order has no meaning.
struct Triangle {
    std::uint32_t a, b, c;
};

struct SpawnPoint {
    Vec3f eye;
    float yaw;  // radians, counterclockwise from the x axis
};

// A camera that stands still. A picture 90 degrees wide in the format 16:9, with a level horizon.
struct FixedShot {
    Vec3f position = Vec3f::Zero();
    float yaw = 0.0F;                  // rad, counterclockwise from the x axis seen from above; within a turn
    float pitch = 0.0F;                // rad, upwards; less than a quarter turn
    std::uint32_t spawn_point = none;  // the nearest one, which names it

    bool operator==(const FixedShot&) const = default;
};

inline constexpr std::size_t max_fixed_shots = 16;  // of a map

// One number of the bake's report, in the order of the stages: "sample", "points", 52310.
struct Count {
    std::string stage;
    std::string what;
    double value;
};

struct Metadata {
    std::string map_name;
    std::string source_name;        // what the map was baked from, as it was given to the bake
    std::uint64_t source_hash = 0;  // xxh3-64 of the source map's bytes
    float metres_per_unit = 1.0F;   // > 0
    float d0 = 0.0F;         // > 0, at most coordinate_limit: sampling distance that was used, map units
    std::string parameters;  // the bake's parameters as a JSON object; not parsed here
    // The bake's report, without its seconds: equal input gives equal bytes. Fewer than 10,000.
    std::vector<Count> counts;
};

// What a bake makes and `encode` writes, in memory that the caller owns.
struct Contents {
    Metadata metadata;
    std::vector<Vertex> vertices;
    std::vector<Triangle> triangles;
    std::vector<SpawnPoint> spawn_points;
    std::vector<MoverShape> movers;
    std::vector<FixedShot> fixed_shots;
};

class Lookouts;
class RoadmapGraph;
class SlabOctree;

// Does not own the mesh.
struct MeshView {
    std::span<const Vertex> vertices;
    std::span<const Triangle> triangles;
};

// Immutable; all members are thread-safe, and so are the queries. Cheap to copy: copies share the storage,
// which lives as long as one of them; spans and references point into it. One that was moved from may only be
// assigned to or destroyed.
class Freespace {
  public:
    // Reads a MAP.vfs into memory, verifies it (identifier, version, size, hash, range of every reference,
    // finite numbers), and makes the incidence in linear time. Changes to the file afterwards have no effect.
    // Fails when the file cannot be read, is no MAP.vfs, is damaged or truncated, or was written by another
    // version of the format; the message names the file. After a success no query leaves the arrays, whatever
    // the bytes were.
    [[nodiscard]] static Result<Freespace> open(const std::filesystem::path& path);

    // The same from bytes in memory, which are kept. `name` stands for the path in messages.
    [[nodiscard]] static Result<Freespace> parse(std::vector<std::byte> bytes, const std::string& name);

    [[nodiscard]] const Metadata& metadata() const;
    // As the file says: of all vertices; without any, the origin.
    [[nodiscard]] const Box3f& bounds() const;
    [[nodiscard]] std::span<const SpawnPoint> spawn_points() const;
    // What moves in the map, in the order of the bake's contents; the mesh is baked as if it were not there.
    [[nodiscard]] std::span<const MoverShape> movers() const;
    // That together have much of the map in their pictures, the one that shows most first.
    [[nodiscard]] std::span<const FixedShot> fixed_shots() const;
    // Bytes of the file that the representation was read from.
    [[nodiscard]] std::size_t byte_size() const;

    [[nodiscard]] std::span<const Vertex> vertices() const { return mesh_.vertices; }
    [[nodiscard]] std::span<const Triangle> triangles() const { return mesh_.triangles; }
    // Triangles that have `vertex` (< vertices().size()) as a corner, ascending.
    [[nodiscard]] std::span<const std::uint32_t> incident(std::uint32_t vertex) const {
        const std::uint32_t first = incident_offsets_[vertex];
        return incident_triangles_.subspan(first, incident_offsets_[vertex + 1] - first);
    }
    [[nodiscard]] const MeshView& mesh() const { return mesh_; }

    // What the queries look up. Each is made when it is first asked for, which takes tens of milliseconds
    // (others wait meanwhile) and allocates.
    [[nodiscard]] const SlabOctree& octree() const;
    [[nodiscard]] const RoadmapGraph& roadmap() const;
    [[nodiscard]] const Lookouts& lookouts() const;

  private:
    struct Storage;
    explicit Freespace(std::shared_ptr<const Storage> storage);
    static Result<Freespace> read(std::shared_ptr<Storage> storage, const std::string& name);

    std::shared_ptr<const Storage> storage_;
    // In storage_.
    MeshView mesh_;
    // Of each vertex its triangles, ascending; where they begin, and one more at the end.
    std::span<const std::uint32_t> incident_triangles_, incident_offsets_;
};

// The bytes of a MAP.vfs, which `parse` accepts: adds bounds, hints, size and hash, and puts triangles and
// vertices in the order of the query index, so that what is near in space is near in memory. The same
// contents give the same bytes. Thread-safe. Preconditions (asserted): a file below 2 GiB, indices in range,
// three different corners a triangle, vertices within +-coordinate_limit, finite spawn points, metadata,
// movers and fixed shots in the ranges given there.
[[nodiscard]] std::vector<std::byte> encode(const Contents& contents);

}  // namespace camdir::freespace
