#include "maps/loader.hpp"

#include <spdlog/spdlog.h>

#include <chrono>
#include <set>

#include "maps/bake_map.hpp"
#include "maps/guarded.hpp"
#include "maps/source.hpp"

namespace camdir::maps {
namespace {

namespace fs = std::filesystem;

std::string percent(const bake::Progress& progress) {
    std::string text = "baking: " + std::string(progress.stage);
    if (progress.total > 0) text += " " + std::to_string(100 * progress.done / progress.total) + " %";
    return text;
}

}  // namespace

Result<void> check_map(const config::Map& map) {
    if (map.source.empty()) {
        const auto opened = freespace::Freespace::open(map.file);
        if (!opened) return tl::unexpected(opened.error());
        return {};
    }
    const auto options = read_options_of(map);
    if (!options) return tl::unexpected(options.error());
    const auto freshness = examine(map);
    if (!freshness) return tl::unexpected(freshness.error());
    return {};
}

void MapLoader::load(const std::vector<config::Map>& maps) {
    stop();
    std::set<std::string> listed;
    for (const config::Map& map : maps)
        listed.insert(map.name);
    for (const std::string& name : library_.names()) {
        if (listed.contains(name)) continue;
        library_.remove(name);
        loaded_.erase(name);
    }
    std::vector<config::Map> wanted;
    for (const config::Map& map : maps) {
        if (unchanged(map)) continue;
        library_.add(map.name, map.strict);
        wanted.push_back(map);
    }
    changed_();
    thread_ = std::jthread([this, wanted](const std::stop_token& token) { work(token, wanted); });
}

void MapLoader::stop() {
    if (!thread_.joinable()) return;
    thread_.request_stop();
    thread_.join();
}

void MapLoader::work(const std::stop_token& stop, const std::vector<config::Map>& maps) {
    std::vector<config::Map> to_bake;
    for (const config::Map& map : maps)
        if (!stop.stop_requested() && !open_if_current(map)) to_bake.push_back(map);
    for (const config::Map& map : to_bake)
        if (!stop.stop_requested()) bake_and_open(map, stop);
}

// False: the map is to be baked.
bool MapLoader::open_if_current(const config::Map& map) {
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
    library_.set_loading(map.name, "waits to be baked");
    return false;
}

void MapLoader::bake_and_open(const config::Map& map, const std::stop_token& stop) {
    spdlog::info("map {}: baking {}", map.name, map.source);
    library_.set_loading(map.name, "baking");
    const auto begin = std::chrono::steady_clock::now();
    const auto show = [&](const bake::Progress& p) { library_.set_loading(map.name, percent(p)); };
    const auto baked = bake_map(map, {}, show, stop);
    if (!baked && baked.error().code == ErrorCode::interrupted) return;
    if (!baked) return set_failed(map, baked.error());
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
    spdlog::info("map {}: baked in {:.1f} s", map.name, seconds.count());
    open(map, seconds.count());
}

void MapLoader::open(const config::Map& map, double bake_seconds) {
    auto opened = guarded(map.file, [&] { return freespace::Freespace::open(map.file); });
    if (!opened) return set_failed(map, opened.error());
    spdlog::info("map {}: {} vertices, {} triangles", map.name, opened->vertices().size(),
                 opened->triangles().size());
    remember(map);
    library_.set_ready(map.name, std::move(*opened), bake_seconds);
    changed_();
}

void MapLoader::set_failed(const config::Map& map, const Error& error) {
    spdlog::error("map {}: {}", map.name, error.message);
    loaded_.erase(map.name);
    library_.set_failed(map.name, error.message);
    changed_();
}

bool MapLoader::unchanged(const config::Map& map) const {
    const auto found = loaded_.find(map.name);
    if (found == loaded_.end()) return false;
    const Origin& origin = found->second;
    std::error_code error;
    return origin.map == map && fs::last_write_time(map.file, error) == origin.written &&
           fs::file_size(map.file, error) == origin.size && !error;
}

void MapLoader::remember(const config::Map& map) {
    std::error_code error;
    loaded_[map.name] = {map, fs::last_write_time(map.file, error), fs::file_size(map.file, error)};
}

}  // namespace camdir::maps
