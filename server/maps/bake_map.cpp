#include "maps/bake_map.hpp"

#include <chrono>
#include <filesystem>
#include <system_error>
#include <thread>
#include <utility>

#include "bake/parameters_json.hpp"
#include "base/file.hpp"
#include "config/json_text.hpp"
#include "freespace/freespace.hpp"
#include "maps/guarded.hpp"
#include "maps/memory.hpp"
#include "maps/source.hpp"
#include "scene/load.hpp"

namespace camdir::maps {
namespace {

using nlohmann::json;

// The first parameter that differs: "d0 64.0 instead of 48.0".
std::string difference(const std::string& baked, const std::string& configured) {
    if (baked == configured) return {};
    auto was = config::parse_json(baked);
    const json now = json::parse(configured);
    if (!was || !was->is_object()) return "parameters that this version cannot read";
    was->erase("kind");
    for (const auto& [name, value] : now.items()) {
        if (!was->contains(name)) return "no " + name + " instead of " + value.dump();
        if ((*was)[name] != value) return name + " " + (*was)[name].dump() + " instead of " + value.dump();
    }
    for (const auto& [name, value] : was->items())
        if (!now.contains(name)) return name + " " + value.dump() + " instead of none";
    return {};
}

Result<PendingFile> claim(const std::string& file, const bake::ProgressSink& progress,
                          const std::stop_token& stop) {
    constexpr std::chrono::milliseconds pause{50};
    for (;;) {
        auto claimed = PendingFile::begin(file);
        if (!claimed) return tl::unexpected(claimed.error());
        if (*claimed) return std::move(**claimed);
        if (stop.stop_requested())
            return fail("interrupted while another process baked " + file, ErrorCode::interrupted);
        if (progress) progress({"waiting for another bake", 0, 0});
        std::this_thread::sleep_for(pause);
    }
}

Result<BakeReport> bake_into(PendingFile file, const config::Map& map, const MapBakeParameters& how,
                             const bake::ProgressSink& progress, const std::stop_token& stop) {
    const auto scene = load_source(map);
    if (!scene) return tl::unexpected(scene.error());
    bake::Parameters parameters = parameters_of(map);
    parameters.threads = how.threads;
    parameters.memory = how.memory;
    const auto baked = bake::bake(*scene, parameters, progress, stop);
    if (!baked) return tl::unexpected(baked.error());
    const std::vector<std::byte> bytes = freespace::encode(baked->contents);
    if (auto written = std::move(file).finish(bytes); !written) return tl::unexpected(written.error());
    return report_of(*scene, *baked, bytes.size());
}

Result<Freshness> freshness_of(const config::Map& map) {
    const auto hash = scene::hash_source(map.source);
    const auto opened = freespace::Freespace::open(map.file);
    if (!opened && !hash) return tl::unexpected(hash.error());
    if (!opened) {
        std::error_code unreachable;  // as a loop of symbolic links is
        const bool missing = !std::filesystem::exists(map.file, unreachable);
        if (unreachable) return tl::unexpected(opened.error());
        return Freshness{missing ? map.file + " was not there" : opened.error().message, "", *hash};
    }
    if (!hash) return Freshness{"", hash.error().message + ": " + map.file + " is used as it is", {}};
    if (opened->metadata().source_hash != *hash)
        return Freshness{"it was baked from other bytes (" + opened->metadata().source_name + ") than " +
                             map.source + " has",
                         "", *hash};
    const auto options = read_options_of(map);
    if (!options) return tl::unexpected(options.error());
    const std::string other =
        difference(opened->metadata().parameters, bake::to_json(parameters_of(map), *options));
    return Freshness{other.empty() ? "" : "it was baked with " + other, "", *hash};
}

}  // namespace

static_assert(config::min_d0 == bake::min_d0 && config::max_d0 == bake::max_d0);

bake::Parameters parameters_of(const config::Map& map) {
    bake::Parameters parameters;
    parameters.d0 = map.d0;
    parameters.sampling = bake::sampling_named(map.sampling).value();
    parameters.loss = map.loss;
    parameters.triangles = static_cast<std::uint64_t>(map.triangles);
    return parameters;
}

Result<Freshness> examine(const config::Map& map) {
    return guarded(map.source, [&] { return freshness_of(map); });
}

Result<std::uint64_t> memory_needed(const config::Map& map) {
    return guarded(map.source, [&]() -> Result<std::uint64_t> {
        const auto scene = load_source(map);
        if (!scene) return tl::unexpected(scene.error());
        return estimate_memory(*scene, bake::sampling_distance(*scene, parameters_of(map)));
    });
}

Result<std::optional<BakeReport>> bake_map(const config::Map& map, const MapBakeParameters& parameters,
                                           const bake::ProgressSink& progress, const std::stop_token& stop) {
    auto file = claim(map.file, progress, stop);
    if (!file) return tl::unexpected(file.error());
    const auto freshness = examine(map);
    if (freshness && freshness->stale.empty() && !parameters.force) return std::nullopt;
    return guarded(map.source, [&]() -> Result<std::optional<BakeReport>> {
        return bake_into(std::move(*file), map, parameters, progress, stop);
    });
}

}  // namespace camdir::maps
