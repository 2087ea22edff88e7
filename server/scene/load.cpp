#include "scene/load.hpp"

#include <xxhash.h>

#include <cstring>
#include <span>
#include <utility>

#include "scene/q3_scene.hpp"
#include "scene/quake_scene.hpp"
#include "scene/source.hpp"

namespace camdir::scene {
namespace {

std::uint64_t hash_of(const Bytes& bytes) {
    return XXH3_64bits(bytes.data(), bytes.size());
}

Result<Scene> read_scene(std::span<const std::byte> bytes) {
    if (is_q3_bsp(bytes)) return read_q3_scene(bytes);
    if (is_quake_bsp(bytes)) return read_quake_scene(bytes);
    return fail(
        "unknown format; expected a BSP of Quake (starts with version 29), of GoldSrc (version 30) or of "
        "Quake 3 (IBSP and version 46)");
}

}  // namespace

Result<Scene> load(const std::string& source) {
    Result<Source> read = read_source(source);
    if (!read) return tl::unexpected(read.error());
    Result<Scene> scene = read_scene(read->bytes);
    if (!scene) return fail(source + ": " + scene.error().message);
    scene->name = std::move(read->map_name);
    scene->source = source;
    scene->source_hash = hash_of(read->bytes);
    return scene;
}

Result<std::uint64_t> hash_source(const std::string& source) {
    const Result<Source> read = read_source(source);
    if (!read) return tl::unexpected(read.error());
    return hash_of(read->bytes);
}

}  // namespace camdir::scene
