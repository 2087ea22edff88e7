#include "maps/loader.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <set>
#include <utility>

#include "maps/bake_map.hpp"
#include "maps/guarded.hpp"
#include "maps/memory.hpp"
#include "maps/progress.hpp"
#include "maps/source.hpp"
#include "scene/load.hpp"

namespace camdir::maps {
namespace {

namespace fs = std::filesystem;

// `baking: certify, 40 %`
std::string activity_of(const BakeProgress& progress, double seconds) {
    return "baking: " + progress.stage() + ", " +
           std::to_string(static_cast<int>(100.0 * progress.fraction(seconds))) + " %";
}

// Of a file that does not open.
Error with_advice(const config::Map& map, Error error) {
    if (map.source.empty()) error.message += "; expected a baked map, or a source to bake it from";
    return error;
}

}  // namespace

Result<void> check_map(const config::Map& map) {
    if (map.source.empty()) {
        const auto opened = guarded(map.file, [&] { return freespace::Freespace::open(map.file); });
        if (opened) return {};
        return tl::unexpected(with_advice(map, opened.error()));
    }
    const auto options = read_options_of(map);
    if (!options) return tl::unexpected(options.error());
    const auto freshness = examine(map);
    if (!freshness) return tl::unexpected(freshness.error());
    return {};
}

void Loader::load(std::vector<config::Map> maps) {
    const std::lock_guard lock(mutex_);  // after it, what is stopped says nothing of it any more
    examining_ = true;
    opening_.request_stop();
    to_open_ = std::move(maps);
    wanted_.notify_all();
    if (!opener_.joinable())
        opener_ = std::jthread([this](const std::stop_token& stop) { open_lists(stop); });
    if (!baker_.joinable()) baker_ = std::jthread([this](const std::stop_token& stop) { bake_all(stop); });
}

void Loader::open_lists(const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    while (wanted_.wait(lock, stop, [&] { return to_open_.has_value(); })) {
        const std::vector<config::Map> maps = *std::exchange(to_open_, std::nullopt);
        opening_ = std::stop_source();
        const std::stop_token stop_opening = opening_.get_token();
        lock.unlock();
        open_list(maps, stop_opening);
        lock.lock();
    }
}

std::optional<Loader::Work> Loader::begin(const std::vector<config::Map>& maps, const std::stop_token& stop) {
    std::vector<std::optional<FileState>> files;
    for (const config::Map& map : maps)
        files.push_back(state_of(map.file));
    const std::lock_guard lock(mutex_);
    if (stop.stop_requested()) return std::nullopt;
    Work work;
    to_bake_.clear();
    work.kept = keep_bake(maps);
    remove_unlisted(maps);
    for (std::size_t i = 0; i < maps.size(); ++i) {
        const config::Map& map = maps[i];
        if (work.kept && map == work.kept->map) continue;
        if (is_unchanged(map, files[i])) {
            work.unchanged.push_back(map);
            continue;
        }
        loaded_.erase(map.name);  // until it is loaded again, which another call may stop
        sink_.added(map);
        work.changed.push_back(map);
    }
    return work;
}

// The running bake, where its map is listed as before; else it is stopped.
std::optional<Loader::Bake> Loader::keep_bake(const std::vector<config::Map>& maps) {
    if (!baking_) return std::nullopt;
    const bool is_listed = std::ranges::find(maps, baking_->map) != maps.end();
    if (is_listed && !baking_->stop.stop_requested()) return baking_;
    baking_->stop.request_stop();
    return std::nullopt;
}

void Loader::remove_unlisted(const std::vector<config::Map>& maps) {
    std::set<std::string> listed;
    for (const config::Map& map : maps)
        listed.insert(map.name);
    for (const std::string& name : listed_) {
        if (listed.contains(name)) continue;
        loaded_.erase(name);
        sink_.removed(name);
    }
    listed_ = std::move(listed);
}

void Loader::stop() {
    {
        const std::lock_guard lock(mutex_);
        to_open_.reset();
        to_bake_.clear();
        opening_.request_stop();
        if (baking_) baking_->stop.request_stop();
    }
    for (std::jthread* thread : {&opener_, &baker_}) {
        if (!thread->joinable()) continue;
        thread->request_stop();
        thread->join();
    }
}

// A file that it has begun to open is opened though it be stopped.
void Loader::open_list(const std::vector<config::Map>& maps, const std::stop_token& stop) {
    const auto work = begin(maps, stop);
    if (!work) return;
    std::vector<config::Map> changed = work->changed;
    if (work->kept && !goes_on(*work->kept)) changed.insert(changed.begin(), work->kept->map);
    std::vector<config::Map> to_bake;
    for (const config::Map& map : changed) {
        wait_for_stopped_bake(map.file, stop);
        if (!stop.stop_requested() && !open_if_current(map)) to_bake.push_back(map);
    }
    want_bakes(to_bake, stop);
    for (const config::Map& map : work->unchanged)
        if (!stop.stop_requested() && begins_anew(map)) want_bakes({map}, stop);
    unless_stopped(stop, [&] { examining_ = false; });
}

void Loader::want_bakes(const std::vector<config::Map>& maps, const std::stop_token& stop) {
    unless_stopped(stop, [&] {
        to_bake_.insert(to_bake_.end(), maps.begin(), maps.end());
        wanted_.notify_all();
    });
}

// False: the map is to be loaded anew, because its source was replaced, what is baked has been put in place,
// or the bake has failed meanwhile.
bool Loader::goes_on(const Bake& kept) {
    const auto freshness = examine(kept.map);
    const bool there = freshness && freshness->stale.empty() && freshness->warning.empty();
    const bool replaced =
        freshness && freshness->source_hash && kept.source_hash && freshness->source_hash != kept.source_hash;
    const std::lock_guard lock(mutex_);
    const bool runs = baking_ && baking_->map == kept.map;
    const bool wanted = runs ? baking_->is_in_place || !there : loaded_.contains(kept.map.name);
    if (wanted && !replaced) return true;
    if (replaced)
        spdlog::info("map {}: {} has changed: its bake begins anew", kept.map.name, kept.map.source);
    if (runs) baking_->stop.request_stop();
    loaded_.erase(kept.map.name);
    return false;
}

// It may still put its result in place of a file that is about to be opened.
void Loader::wait_for_stopped_bake(const std::string& file, const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    wanted_.wait(lock, stop,
                 [&] { return !baking_ || !baking_->stop.stop_requested() || baking_->map.file != file; });
}

// False: the map must be baked.
bool Loader::open_if_current(const config::Map& map) {
    const std::stop_token never;
    if (map.source.empty()) {
        open(map, 0.0, never);
        return true;
    }
    const auto freshness = examine(map);
    if (!freshness) {
        set_failed(map, freshness.error(), never);
        return true;
    }
    if (!freshness->warning.empty()) spdlog::warn("map {}: {}", map.name, freshness->warning);
    if (freshness->stale.empty()) {
        open(map, 0.0, never);
        return true;
    }
    spdlog::info("map {}: will be baked: {}", map.name, freshness->stale);
    unless_stopped(never, [&] { sink_.loading(map.name, "waiting to be baked"); });
    return false;
}

// A loaded map whose source was replaced: it is served as it is until it is baked again.
bool Loader::begins_anew(const config::Map& map) {
    if (map.source.empty()) return false;
    const auto freshness = examine(map);
    const std::string warning =
        freshness ? freshness->warning : freshness.error().message + "; the map is served as it was";
    if (!warning.empty()) spdlog::warn("map {}: {}", map.name, warning);
    if (!freshness || freshness->stale.empty()) return false;
    spdlog::info("map {}: will be baked again: {}", map.name, freshness->stale);
    const std::lock_guard lock(mutex_);
    loaded_.erase(map.name);
    sink_.added(map);
    sink_.loading(map.name, "waiting to be baked");
    return true;
}

void Loader::bake_all(const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    while (wanted_.wait(lock, stop, [&] { return !to_bake_.empty(); })) {
        const config::Map map = to_bake_.front();
        to_bake_.pop_front();
        const std::stop_token stop_bake = baking_.emplace(Bake{map, {}, {}, false}).stop.get_token();
        lock.unlock();
        bake_and_open(map, stop_bake);
        lock.lock();
        baking_.reset();
        wanted_.notify_all();
    }
}

void Loader::bake_and_open(const config::Map& map, const std::stop_token& stop) {
    spdlog::info("map {}: baking {}", map.name, map.source);
    note_source_hash(map);
    unless_stopped(stop, [&] { sink_.loading(map.name, "baking"); });
    const auto begin = std::chrono::steady_clock::now();
    const auto seconds = [&] {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    };
    BakeProgress progress;
    const auto show = [&](const bake::Progress& stage) {
        progress.update(stage, seconds());
        unless_stopped(stop, [&] { sink_.loading(map.name, activity_of(progress, seconds())); });
    };
    const auto baked = bake_map(map, {.memory = available_memory()}, show, stop);
    if (stop.stop_requested() || (!baked && baked.error().code == ErrorCode::interrupted)) return;
    if (!baked) return set_failed(map, baked.error(), stop);
    unless_stopped(stop, [&] { baking_->is_in_place = true; });
    const double bake_seconds = *baked ? seconds() : 0.0;  // another process has baked it meanwhile
    if (*baked) spdlog::info("map {}: baked in {:.1f} s", map.name, bake_seconds);
    open(map, bake_seconds, stop);
}

void Loader::open(const config::Map& map, double bake_seconds, const std::stop_token& stop) {
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
    if (!opened) return set_failed(map, with_advice(map, opened.error()), stop);
    spdlog::info("map {}: {} vertices, {} triangles", map.name, opened->vertices().size(),
                 opened->triangles().size());
    unless_stopped(stop, [&] {
        loaded_[map.name] = {map, file};
        sink_.ready(map.name, std::move(*opened), bake_seconds);
    });
}

void Loader::set_failed(const config::Map& map, const Error& error, const std::stop_token& stop) {
    unless_stopped(stop, [&] {
        spdlog::error("map {}: {}", map.name, error.message);
        loaded_.erase(map.name);
        sink_.failed(map.name, error.message);
    });
}

// What is stopped says nothing any more of a map that load() has removed or begun anew.
template <class Tell>
void Loader::unless_stopped(const std::stop_token& stop, const Tell& tell) {
    const std::lock_guard lock(mutex_);
    if (!stop.stop_requested()) tell();
}

// Before it is read to be baked: a replacement between costs a needless new bake at the next load().
void Loader::note_source_hash(const config::Map& map) {
    const auto hash = guarded(map.source, [&] { return scene::hash_source(map.source); });
    const std::lock_guard lock(mutex_);
    baking_->source_hash = hash.value_or(0);
}

bool Loader::is_unchanged(const config::Map& map, const std::optional<FileState>& file) const {
    const auto found = loaded_.find(map.name);
    if (found == loaded_.end()) return false;
    const LoadedFile& loaded = found->second;
    return loaded.map == map && loaded.file && file == loaded.file;
}

std::optional<Loader::FileState> Loader::state_of(const std::string& file) {
    std::error_code no_time;
    std::error_code no_size;
    const FileState state{fs::last_write_time(file, no_time), fs::file_size(file, no_size)};
    if (no_time || no_size) return std::nullopt;
    return state;
}

}  // namespace camdir::maps
