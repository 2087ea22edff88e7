#include "maps/loader.hpp"

#include <spdlog/spdlog.h>

#include <chrono>
#include <set>

#include "maps/bake_map.hpp"
#include "maps/guarded.hpp"
#include "maps/memory.hpp"
#include "maps/progress.hpp"
#include "maps/source.hpp"

namespace camdir::maps {
namespace {

namespace fs = std::filesystem;

// `baking: certify, 40 %`
std::string activity_of(const BakeProgress& progress, double seconds) {
    return "baking: " + progress.stage() + ", " +
           std::to_string(static_cast<int>(100.0 * progress.fraction(seconds))) + " %";
}

}  // namespace

Result<void> check_map(const config::Map& map) {
    if (map.source.empty()) {
        const auto opened = guarded(map.file, [&] { return freespace::Freespace::open(map.file); });
        if (opened) return {};
        return fail(opened.error().message + "; expected a baked map, or a source to bake it from");
    }
    const auto options = read_options_of(map);
    if (!options) return tl::unexpected(options.error());
    const auto freshness = examine(map);
    if (!freshness) return tl::unexpected(freshness.error());
    return {};
}

void Loader::load(const std::vector<config::Map>& maps) {
    stop();
    std::set<std::string> listed;
    for (const config::Map& map : maps)
        listed.insert(map.name);
    for (const std::string& name : listed_) {
        if (listed.contains(name)) continue;
        loaded_.erase(name);
        sink_.removed(name);
    }
    listed_ = std::move(listed);
    std::vector<config::Map> changed;
    for (const config::Map& map : maps) {
        if (is_unchanged(map)) continue;
        loaded_.erase(map.name);  // until it is loaded again, which another call may stop
        sink_.added(map);
        changed.push_back(map);
    }
    thread_ = std::jthread([this, changed](const std::stop_token& token) { run(token, changed); });
}

void Loader::stop() {
    if (!thread_.joinable()) return;
    thread_.request_stop();
    thread_.join();
}

void Loader::run(const std::stop_token& stop, const std::vector<config::Map>& maps) {
    std::vector<config::Map> to_bake;
    for (const config::Map& map : maps)
        if (!stop.stop_requested() && !open_if_current(map)) to_bake.push_back(map);
    for (const config::Map& map : to_bake)
        if (!stop.stop_requested()) bake_and_open(map, stop);
}

// False: the map must be baked.
bool Loader::open_if_current(const config::Map& map) {
    if (map.source.empty()) {
        open(map, 0.0);
        return true;
    }
    const auto freshness = examine(map);
    if (!freshness) {
        set_failed(map, freshness.error());
        return true;
    }
    if (!freshness->warning.empty()) spdlog::warn("map {}: {}", map.name, freshness->warning);
    if (freshness->stale.empty()) {
        open(map, 0.0);
        return true;
    }
    spdlog::info("map {}: will be baked: {}", map.name, freshness->stale);
    sink_.loading(map.name, "waiting to be baked");
    return false;
}

void Loader::bake_and_open(const config::Map& map, const std::stop_token& stop) {
    spdlog::info("map {}: baking {}", map.name, map.source);
    sink_.loading(map.name, "baking");
    const auto begin = std::chrono::steady_clock::now();
    const auto seconds = [&] {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    };
    BakeProgress progress;
    const auto show = [&](const bake::Progress& stage) {
        progress.update(stage, seconds());
        sink_.loading(map.name, activity_of(progress, seconds()));
    };
    const auto baked = bake_map(map, {.memory = available_memory()}, show, stop);
    if (!baked && baked.error().code == ErrorCode::interrupted) return;
    if (!baked) return set_failed(map, baked.error());
    const double bake_seconds = seconds();
    spdlog::info("map {}: baked in {:.1f} s", map.name, bake_seconds);
    open(map, bake_seconds);
}

void Loader::open(const config::Map& map, double bake_seconds) {
    const auto file = state_of(map.file);  // before it is read: it may be replaced meanwhile
    // With what its queries look up: no match's worker must wait for that, or run out of memory.
    auto opened = guarded(map.file, [&] {
        auto freespace = freespace::Freespace::open(map.file);
        if (freespace) {
            static_cast<void>(freespace->octree());
            static_cast<void>(freespace->roadmap());
            static_cast<void>(freespace->lookouts());
        }
        return freespace;
    });
    if (!opened) return set_failed(map, opened.error());
    spdlog::info("map {}: {} vertices, {} triangles", map.name, opened->vertices().size(),
                 opened->triangles().size());
    loaded_[map.name] = {map, file};
    sink_.ready(map.name, std::move(*opened), bake_seconds);
}

void Loader::set_failed(const config::Map& map, const Error& error) {
    spdlog::error("map {}: {}", map.name, error.message);
    loaded_.erase(map.name);
    sink_.failed(map.name, error.message);
}

bool Loader::is_unchanged(const config::Map& map) const {
    const auto found = loaded_.find(map.name);
    if (found == loaded_.end()) return false;
    const LoadedFile& loaded = found->second;
    return loaded.map == map && loaded.file && state_of(map.file) == loaded.file;
}

std::optional<Loader::FileState> Loader::state_of(const std::string& file) {
    std::error_code no_time;
    std::error_code no_size;
    const FileState state{fs::last_write_time(file, no_time), fs::file_size(file, no_size)};
    if (no_time || no_size) return std::nullopt;
    return state;
}

}  // namespace camdir::maps
