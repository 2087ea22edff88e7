// MAP.vfs: writing and reading. The only file that knows FlatBuffers and xxHash.
#include <xxhash.h>

#include <cassert>
#include <cstring>

#include "base/file.hpp"
#include "base/lazy.hpp"
#include "freespace/check.hpp"
#include "freespace/freespace.hpp"
#include "freespace/hints.hpp"
#include "freespace/incidence.hpp"
#include "freespace/index.hpp"
#include "freespace/lookouts.hpp"
#include "freespace/roadmap_graph.hpp"
#include "freespace/slab_octree.hpp"
#include "freespace_generated.h"

namespace camdir::freespace {

static_assert(sizeof(Vertex) == sizeof(wire::Vertex) && sizeof(Triangle) == sizeof(wire::Triangle));
static_assert(sizeof(HalfSpace) == sizeof(wire::HalfSpace) && sizeof(MoverBall) == sizeof(wire::Ball));
static_assert(FLATBUFFERS_MAX_BUFFER_SIZE / sizeof(Triangle) < IndexChild::triangle_limit);

namespace {

constexpr std::uint32_t format_version = 4;
constexpr flatbuffers::uoffset_t table_depth_limit = 4;
constexpr flatbuffers::uoffset_t table_limit =
    1 + count_limit + max_movers;      // the root, its counts and movers
constexpr float smallest_cell = 3.0F;  // of the octree, in d0

// ---- Writing ----

std::vector<Vertex> reorder_vertices(const Contents& contents, std::span<const std::uint32_t> triangle_order,
                                     std::vector<std::uint32_t>& new_number) {
    std::vector<Vertex> vertices;
    vertices.reserve(contents.vertices.size());
    new_number.assign(contents.vertices.size(), none);
    const auto append = [&](std::uint32_t v) {
        if (new_number[v] != none) return;
        new_number[v] = static_cast<std::uint32_t>(vertices.size());
        vertices.push_back(contents.vertices[v]);
    };
    for (const std::uint32_t t : triangle_order) {
        const auto [a, b, c] = contents.triangles[t];
        for (const std::uint32_t corner : {a, b, c})
            append(corner);
    }
    for (std::uint32_t v = 0; v < contents.vertices.size(); ++v)
        append(v);
    return vertices;
}

Box3f bounds_of(std::span<const Vertex> vertices) {
    if (vertices.empty()) return {Vec3f::Zero(), Vec3f::Zero()};
    Box3f bounds;
    for (const Vertex& vertex : vertices)
        bounds.extend(vertex.position());
    return bounds;
}

wire::Point to_wire(const Vec3f& p) {
    return {p.x(), p.y(), p.z()};
}

template <class Wire, class Element>
auto copy_structs(flatbuffers::FlatBufferBuilder& builder, const std::vector<Element>& elements) {
    return builder.CreateVectorOfStructs(reinterpret_cast<const Wire*>(elements.data()), elements.size());
}

auto copy_spawn_points(flatbuffers::FlatBufferBuilder& builder, std::span<const SpawnPoint> spawn_points) {
    std::vector<wire::SpawnPoint> copies;
    for (const SpawnPoint& spawn : spawn_points)
        copies.emplace_back(to_wire(spawn.eye), spawn.yaw);
    return builder.CreateVectorOfStructs(copies);
}

auto copy_counts(flatbuffers::FlatBufferBuilder& builder, std::span<const Count> counts) {
    std::vector<flatbuffers::Offset<wire::Count>> copies;
    for (const Count& count : counts)
        copies.push_back(wire::CreateCount(builder, builder.CreateString(count.stage),
                                           builder.CreateString(count.what), count.value));
    return builder.CreateVector(copies);
}

auto copy_fixed_shots(flatbuffers::FlatBufferBuilder& builder, std::span<const FixedShot> shots) {
    std::vector<wire::FixedShot> copies;
    for (const FixedShot& shot : shots)
        copies.emplace_back(to_wire(shot.position), shot.yaw, shot.pitch, shot.spawn_point);
    return builder.CreateVectorOfStructs(copies);
}

wire::Box to_wire(const Box3f& box) {
    return {to_wire(box.min()), to_wire(box.max())};
}

struct WireMovers {
    flatbuffers::Offset<flatbuffers::Vector<flatbuffers::Offset<wire::Mover>>> movers;
    flatbuffers::Offset<flatbuffers::Vector<const wire::Hull*>> hulls;
    flatbuffers::Offset<flatbuffers::Vector<const wire::HalfSpace*>> half_spaces;
    flatbuffers::Offset<flatbuffers::Vector<const wire::Ball*>> balls;
};

WireMovers copy_movers(flatbuffers::FlatBufferBuilder& builder, std::span<const MoverShape> movers) {
    std::vector<flatbuffers::Offset<wire::Mover>> copies;
    std::vector<wire::Hull> hulls;
    std::vector<HalfSpace> half_spaces;
    std::vector<MoverBall> balls;
    for (const MoverShape& mover : movers) {
        for (const ConvexHull& hull : mover.hulls) {
            hulls.emplace_back(to_wire(hull.bounds), static_cast<std::uint32_t>(hull.half_spaces.size()));
            half_spaces.insert(half_spaces.end(), hull.half_spaces.begin(), hull.half_spaces.end());
        }
        balls.insert(balls.end(), mover.balls.begin(), mover.balls.end());
        const auto name = builder.CreateString(mover.name);
        const auto kind = builder.CreateString(mover.kind);
        const wire::Point rest = to_wire(mover.rest);
        copies.push_back(wire::CreateMover(builder, name, kind, &rest,
                                           static_cast<std::uint32_t>(mover.hulls.size()),
                                           static_cast<std::uint32_t>(mover.balls.size())));
    }
    const auto wire_balls = copy_structs<wire::Ball>(builder, balls);
    const auto wire_half_spaces = copy_structs<wire::HalfSpace>(builder, half_spaces);
    const auto wire_hulls = builder.CreateVectorOfStructs(hulls);
    return {builder.CreateVector(copies), wire_hulls, wire_half_spaces, wire_balls};
}

flatbuffers::DetachedBuffer build_file(const Contents& contents, const std::vector<Vertex>& vertices,
                                       const std::vector<Triangle>& triangles, const Hints& hints) {
    flatbuffers::FlatBufferBuilder builder;
    // A buffer is written back to front: the large arrays go last in the file, behind the root.
    const auto wire_hints = builder.CreateVector(hints.triangles);
    const wire::Extent extent(hints.extent[0], hints.extent[1], hints.extent[2]);
    const auto wire_triangles = copy_structs<wire::Triangle>(builder, triangles);
    const auto wire_vertices = copy_structs<wire::Vertex>(builder, vertices);
    const Metadata& metadata = contents.metadata;
    const WireMovers movers = copy_movers(builder, contents.movers);
    const auto wire_fixed_shots = copy_fixed_shots(builder, contents.fixed_shots);
    const auto wire_spawn_points = copy_spawn_points(builder, contents.spawn_points);
    const auto counts = copy_counts(builder, metadata.counts);
    const auto parameters = builder.CreateString(metadata.parameters);
    const auto source_name = builder.CreateString(metadata.source_name);
    const auto map_name = builder.CreateString(metadata.map_name);
    const wire::Header header(format_version, 0, 0);
    const wire::Box bounds = to_wire(bounds_of(vertices));
    const auto root = wire::CreateFreespace(builder, &header, map_name, source_name, metadata.source_hash,
                                            metadata.metres_per_unit, metadata.d0, parameters, &bounds,
                                            wire_vertices, wire_triangles, hints.cell_size, &extent,
                                            wire_hints, wire_spawn_points, counts, movers.movers,
                                            movers.hulls, movers.half_spaces, movers.balls, wire_fixed_shots);
    wire::FinishFreespaceBuffer(builder, root);
    return builder.Release();
}

// ---- The header ----

// Offset of the content hash in the file that `header` lies in.
std::size_t hash_position(std::span<const std::byte> file, const wire::Header& header) {
    const auto* begin = reinterpret_cast<const std::byte*>(&header);
    return static_cast<std::size_t>(begin - file.data()) + 2 * sizeof(std::uint64_t);
}

std::uint64_t hash_without(std::span<const std::byte> file, std::size_t position) {
    const std::uint64_t zero = 0;
    const auto rest = file.subspan(position + sizeof zero);
    const std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state(XXH3_createState(), &XXH3_freeState);
    XXH3_64bits_reset(state.get());
    XXH3_64bits_update(state.get(), file.data(), position);
    XXH3_64bits_update(state.get(), &zero, sizeof zero);
    XXH3_64bits_update(state.get(), rest.data(), rest.size());
    return XXH3_64bits_digest(state.get());
}

// Sets size and hash, which are known only when everything else is written.
void seal(std::span<std::byte> file) {
    const wire::Header& blank = *wire::GetFreespace(file.data())->header();
    const std::size_t position = hash_position(file, blank);
    const std::uint64_t byte_size = file.size();
    std::memcpy(file.data() + position - sizeof byte_size, &byte_size, sizeof byte_size);
    const std::uint64_t hash = hash_without(file, position);
    std::memcpy(file.data() + position, &hash, sizeof hash);
}

// What is wrong with the file as a whole; if empty, its fields may be read.
std::string find_file_flaw(std::span<const std::byte> file) {
    const auto* data = reinterpret_cast<const std::uint8_t*>(file.data());
    if (file.size() < 64 || !wire::FreespaceBufferHasIdentifier(data))
        return std::string("is not a baked map: expected a file with the identifier ") +
               wire::FreespaceIdentifier();
    if (file.size() >= FLATBUFFERS_MAX_BUFFER_SIZE) return "is larger than 2 GiB";
    flatbuffers::Verifier prologue(data, file.size(), table_depth_limit, table_limit);
    if (!prologue.VerifyBuffer<wire::Prologue>(wire::FreespaceIdentifier()))
        return "is damaged: its header is unreadable";
    const wire::Header& header = *flatbuffers::GetRoot<wire::Prologue>(data)->header();
    if (header.format_version() > format_version)
        return "was written by a newer version: format " + std::to_string(header.format_version()) +
               ", this program reads " + std::to_string(format_version);
    if (header.format_version() != format_version)
        return "was written by an older version: format " + std::to_string(header.format_version()) +
               ", this program reads " + std::to_string(format_version) + "; bake the map again";
    if (header.byte_size() != file.size())
        return "is truncated or damaged: " + std::to_string(file.size()) + " bytes instead of " +
               std::to_string(header.byte_size());
    if (header.content_hash() != hash_without(file, hash_position(file, header)))
        return "is damaged: its content does not have the hash that it was written with";
    flatbuffers::Verifier whole(data, file.size(), table_depth_limit, table_limit);
    if (!wire::VerifyFreespaceBuffer(whole)) return "is damaged: a part of it lies outside the file";
    return {};
}

// ---- Reading ----

template <class Element, class Wire>
std::span<const Element> view(const flatbuffers::Vector<Wire>* vector) {
    return {reinterpret_cast<const Element*>(vector->Data()), vector->size()};
}

Vec3f to_vector(const wire::Point& p) {
    return {p.x(), p.y(), p.z()};
}

HintView view_hints(const wire::Freespace& root) {
    const wire::Extent& extent = *root.hint_extent();
    return {root.hint_cell_size(), {extent.x(), extent.y(), extent.z()}, view<std::uint32_t>(root.hints())};
}

Metadata read_metadata(const wire::Freespace& root) {
    Metadata metadata;
    metadata.map_name = root.map_name()->str();
    metadata.source_name = root.source_name()->str();
    metadata.source_hash = root.source_hash();
    metadata.metres_per_unit = root.metres_per_unit();
    metadata.d0 = root.d0();
    metadata.parameters = root.parameters()->str();
    for (const wire::Count* count : *root.counts())
        metadata.counts.push_back({count->stage()->str(), count->what()->str(), count->value()});
    return metadata;
}

std::vector<SpawnPoint> read_spawn_points(const wire::Freespace& root) {
    std::vector<SpawnPoint> spawn_points;
    for (const wire::SpawnPoint* spawn : *root.spawn_points())
        spawn_points.push_back({to_vector(spawn->eye()), spawn->yaw()});
    return spawn_points;
}

std::vector<FixedShot> read_fixed_shots(const wire::Freespace& root) {
    std::vector<FixedShot> shots;
    for (const wire::FixedShot* shot : *root.fixed_shots())
        shots.push_back({to_vector(shot->position()), shot->yaw(), shot->pitch(), shot->spawn_point()});
    return shots;
}

Box3f to_box(const wire::Box& box) {
    return {to_vector(box.min()), to_vector(box.max())};
}

// Takes `count` elements from the front of `rest`; false when there are not so many.
template <class Element>
bool take(std::span<const Element>& rest, std::size_t count, std::vector<Element>& to) {
    if (count > rest.size()) return false;
    to.assign(rest.begin(), rest.begin() + static_cast<std::ptrdiff_t>(count));
    rest = rest.subspan(count);
    return true;
}

// What is wrong with the numbers of hulls, half spaces and balls; if empty, `movers` are all of the file's.
std::string read_movers(const wire::Freespace& root, std::vector<MoverShape>& movers) {
    auto hulls = view<wire::Hull>(root.hulls());
    auto half_spaces = view<HalfSpace>(root.half_spaces());
    auto balls = view<MoverBall>(root.balls());
    if (root.movers()->size() > max_movers) return "there are too many movers";
    for (const wire::Mover* stored : *root.movers()) {
        // Names may be shared, and are limited before they are copied.
        if (stored->name()->size() > max_mover_name || stored->kind()->size() > max_mover_name)
            return "a mover has a name or a kind that is too long";
        MoverShape& mover = movers.emplace_back();
        mover.name = stored->name()->str();
        mover.kind = stored->kind()->str();
        mover.rest = to_vector(*stored->rest());
        std::vector<wire::Hull> own_hulls;
        if (!take(hulls, stored->hulls(), own_hulls) || !take(balls, stored->balls(), mover.balls))
            return "a mover has hulls or balls that do not exist";
        for (const wire::Hull& hull : own_hulls) {
            ConvexHull& copy = mover.hulls.emplace_back();
            copy.bounds = to_box(hull.bounds());
            if (!take(half_spaces, hull.half_spaces(), copy.half_spaces))
                return "a hull has half spaces that do not exist";
        }
    }
    if (!hulls.empty() || !half_spaces.empty() || !balls.empty())
        return "there are hulls, half spaces or balls of no mover";
    return {};
}

}  // namespace

struct Freespace::Storage {
    Bytes file;
    Metadata metadata;
    Box3f bounds;
    std::vector<SpawnPoint> spawn_points;
    std::vector<MoverShape> movers;
    std::vector<FixedShot> fixed_shots;
    MeshView mesh;  // in file
    Incidence incidence;
    Lazy<SlabOctree> octree;
    Lazy<RoadmapGraph> roadmap;
    Lazy<Lookouts> lookouts;

    explicit Storage(Bytes bytes) : file(std::move(bytes)) {}
};

Freespace::Freespace(std::shared_ptr<const Storage> storage)
    : storage_(std::move(storage)),
      mesh_(storage_->mesh),
      incident_triangles_(storage_->incidence.triangles),
      incident_offsets_(storage_->incidence.offsets) {}

Result<Freespace> Freespace::read(std::shared_ptr<Storage> storage, const std::string& name) {
    const std::span<const std::byte> bytes = storage->file;
    if (const std::string flaw = find_file_flaw(bytes); !flaw.empty()) return fail(name + ": " + flaw);
    const wire::Freespace& root = *wire::GetFreespace(bytes.data());
    storage->metadata = read_metadata(root);
    storage->spawn_points = read_spawn_points(root);
    storage->fixed_shots = read_fixed_shots(root);
    storage->bounds = to_box(*root.bounds());
    const auto vertices = view<Vertex>(root.vertices());
    const auto triangles = view<Triangle>(root.triangles());
    const HintView hints = view_hints(root);
    std::string flaw = find_metadata_flaw(storage->metadata, storage->spawn_points);
    if (flaw.empty()) flaw = read_movers(root, storage->movers);
    if (flaw.empty()) flaw = find_movers_flaw(storage->movers);
    if (flaw.empty()) flaw = find_fixed_shots_flaw(storage->fixed_shots, storage->spawn_points.size());
    if (flaw.empty()) flaw = find_mesh_flaw(vertices, triangles);
    if (flaw.empty()) flaw = find_bounds_flaw(storage->bounds, vertices);
    if (flaw.empty()) flaw = find_hints_flaw(hints, triangles.size());
    if (!flaw.empty()) return fail(name + ": is damaged: " + flaw);
    storage->incidence = build_incidence(vertices.size(), triangles);
    storage->mesh = {vertices, triangles};
    return Freespace(std::move(storage));
}

// Not memory-mapped: a program that overwrites or truncates the file must not change or crash this one.
Result<Freespace> Freespace::open(const std::filesystem::path& path) {
    auto bytes = read_file(path);
    if (!bytes) return tl::unexpected(bytes.error());
    return parse(std::move(*bytes), path.string());
}

Result<Freespace> Freespace::parse(std::vector<std::byte> bytes, const std::string& name) {
    return read(std::make_shared<Storage>(std::move(bytes)), name);
}

const Metadata& Freespace::metadata() const {
    return storage_->metadata;
}

const Box3f& Freespace::bounds() const {
    return storage_->bounds;
}

std::span<const SpawnPoint> Freespace::spawn_points() const {
    return storage_->spawn_points;
}

std::span<const MoverShape> Freespace::movers() const {
    return storage_->movers;
}

std::span<const FixedShot> Freespace::fixed_shots() const {
    return storage_->fixed_shots;
}

const SlabOctree& Freespace::octree() const {
    return storage_->octree.get(
        [&] { return SlabOctree(mesh_.vertices, mesh_.triangles, smallest_cell * metadata().d0); });
}

const RoadmapGraph& Freespace::roadmap() const {
    return storage_->roadmap.get([&] { return RoadmapGraph(mesh_.vertices, mesh_.triangles); });
}

const Lookouts& Freespace::lookouts() const {
    return storage_->lookouts.get([&] { return Lookouts(*this); });
}

std::size_t Freespace::byte_size() const {
    return storage_->file.size();
}

std::vector<std::byte> encode(const Contents& contents) {
    assert(contents.triangles.size() < IndexChild::triangle_limit);
    assert(find_metadata_flaw(contents.metadata, contents.spawn_points).empty());
    assert(find_movers_flaw(contents.movers).empty());
    assert(find_fixed_shots_flaw(contents.fixed_shots, contents.spawn_points.size()).empty());
    assert(find_mesh_flaw(contents.vertices, contents.triangles).empty());
    const std::vector<std::uint32_t> order = index_order(contents.vertices, contents.triangles);
    std::vector<std::uint32_t> new_number;
    const std::vector<Vertex> vertices = reorder_vertices(contents, order, new_number);
    std::vector<Triangle> triangles;
    triangles.reserve(contents.triangles.size());
    for (const std::uint32_t t : order) {
        const auto [a, b, c] = contents.triangles[t];
        triangles.push_back({new_number[a], new_number[b], new_number[c]});
    }
    const std::vector<IndexNode> index = build_index(vertices, triangles);
    const Hints hints = build_hints({vertices, triangles}, index, bounds_of(vertices));
    const auto buffer = build_file(contents, vertices, triangles, hints);
    const auto built = std::as_bytes(std::span(buffer.data(), buffer.size()));
    std::vector<std::byte> file(built.begin(), built.end());
    seal(file);
    return file;
}

}  // namespace camdir::freespace
