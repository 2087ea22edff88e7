#include "scene/load.hpp"

#include <xxhash.h>

#include <memory>
#include <span>
#include <sstream>
#include <utility>

#include "scene/format.hpp"
#include "scene/mesh/gltf_buffers.hpp"
#include "scene/quake/read_scene.hpp"
#include "scene/quake3/read_scene.hpp"
#include "scene/source.hpp"

namespace camdir::scene {
namespace {

using Format = std::variant<std::monostate, MeshFormat, CloudFormat>;

struct CompanionFile {
    std::string name;  // as the map's file writes it
    Bytes bytes;
};

// A map with the files that it refers to.
struct Content {
    Source source;
    Format format;
    std::vector<CompanionFile> companions;

    [[nodiscard]] std::uint64_t hash() const {
        const std::unique_ptr<XXH3_state_t, XXH_errorcode (*)(XXH3_state_t*)> state(XXH3_createState(),
                                                                                    XXH3_freeState);
        XXH3_64bits_reset(state.get());
        XXH3_64bits_update(state.get(), source.bytes.data(), source.bytes.size());
        for (const CompanionFile& companion : companions)
            XXH3_64bits_update(state.get(), companion.bytes.data(), companion.bytes.size());
        return XXH3_64bits_digest(state.get());
    }
};

Result<std::vector<CompanionFile>> read_gltf_companions(const std::string& source, const Bytes& bytes) {
    const auto buffers = gltf_buffers(bytes);
    if (!buffers) return fail(source + ": " + buffers.error().message);
    std::vector<CompanionFile> companions;
    for (const GltfBuffer& buffer : *buffers) {
        auto read = read_source(beside(source, buffer.path));
        if (!read) return fail(source + ": a buffer is missing: " + read.error().message);
        if (read->bytes.size() < buffer.byte_length)
            return fail(beside(source, buffer.path) + ": ends after " + std::to_string(read->bytes.size()) +
                        " bytes; " + source + " expects " + std::to_string(buffer.byte_length));
        companions.push_back({buffer.uri, std::move(read->bytes)});
    }
    return companions;
}

Result<Content> read_content(const std::string& source) {
    auto read = read_source(source);
    if (!read) return tl::unexpected(read.error());
    const auto format = format_of(read->bytes, read->extension);
    if (!format) return fail(source + ": " + format.error().message);
    Content content{std::move(*read), *format, {}};
    const auto* mesh = std::get_if<MeshFormat>(&content.format);
    if (mesh != nullptr && (*mesh == MeshFormat::gltf || *mesh == MeshFormat::glb)) {
        auto companions = read_gltf_companions(source, content.source.bytes);
        if (!companions) return tl::unexpected(companions.error());
        content.companions = std::move(*companions);
    }
    return content;
}

Result<Scene> read_bsp(std::span<const std::byte> bytes, const ReadOptions& options) {
    const bool is_q3 = is_q3_bsp(bytes);
    if (!is_q3 && !is_quake_bsp(bytes))
        return fail(
            "unknown format; expected a BSP of Quake (starts with version 29), of GoldSrc (version 30) or of "
            "Quake 3 (IBSP and version 46), a mesh (OBJ, PLY, STL, glTF) or a point cloud (PCD, PLY, XYZ, "
            "LAS)");
    if (options.up || options.origin != Vec3d::Zero())
        return fail("a BSP says itself where up and (0, 0, 0) are");
    Result<Scene> scene = is_q3 ? read_q3_scene(bytes) : read_quake_scene(bytes);
    if (!scene) return scene;
    scene->kind = is_q3 ? "BSP (Quake 3)" : "BSP (Quake, GoldSrc)";
    scene->metres_per_unit = options.metres_per_unit.value_or(scene->metres_per_unit);
    return scene;
}

Result<Scene> read_scene(const Content& content, const ReadOptions& options) {
    const Bytes& bytes = content.source.bytes;
    if (const auto* cloud = std::get_if<CloudFormat>(&content.format))
        return read_cloud_scene(bytes, *cloud, options);
    const auto* mesh = std::get_if<MeshFormat>(&content.format);
    if (mesh == nullptr) return read_bsp(bytes, options);
    Companions companions;
    for (const CompanionFile& companion : content.companions)
        companions[companion.name] = companion.bytes;
    return read_mesh_scene(bytes, *mesh, companions, options);
}

Result<void> add_seeds(const std::vector<Vec3d>& seeds, Scene& scene) {
    for (const Vec3d& seed : seeds) {
        if (!scene.bounds.contains(seed)) {
            std::ostringstream text;
            text << "the seed " << seed.transpose() << " lies outside the map's box, "
                 << scene.bounds.min().transpose() << " to " << scene.bounds.max().transpose();
            return fail(text.str());
        }
        scene.spawn_points.push_back({seed, 0.0, "seed"});
    }
    return {};
}

}  // namespace

Result<Scene> load(const std::string& source, const ReadOptions& options) {
    const auto content = read_content(source);
    if (!content) return tl::unexpected(content.error());
    Result<Scene> scene = read_scene(*content, options);
    if (!scene) return fail(source + ": " + scene.error().message);
    const auto seeded = add_seeds(options.seeds, *scene);
    if (!seeded) return fail(source + ": " + seeded.error().message);
    scene->name = content->source.map_name;
    scene->source = source;
    scene->source_hash = content->hash();
    scene->options = options;
    return scene;
}

Result<std::uint64_t> hash_source(const std::string& source) {
    const auto content = read_content(source);
    if (!content) return tl::unexpected(content.error());
    return content->hash();
}

}  // namespace camdir::scene
