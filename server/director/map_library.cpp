#include "director/map_library.hpp"

#include <utility>

namespace camdir::director {

void MapLibrary::add(const std::string& name, bool strict) {
    const std::lock_guard lock(mutex_);
    MapEntry& entry = entries_[name];
    entry.state = LoadState::loading;
    entry.reason.clear();
    entry.strict = strict;
}

void MapLibrary::set_loading(const std::string& name, const std::string& reason) {
    const std::lock_guard lock(mutex_);
    MapEntry& entry = entries_[name];
    entry.state = LoadState::loading;
    entry.reason = reason;
}

void MapLibrary::set_ready(const std::string& name, freespace::Freespace freespace, double bake_seconds) {
    const std::lock_guard lock(mutex_);
    MapEntry& entry = entries_[name];
    entry.state = LoadState::ready;
    entry.reason.clear();
    entry.freespace = std::move(freespace);
    entry.bake_seconds = bake_seconds;
    entry.generation = ++generation_;
}

void MapLibrary::set_failed(const std::string& name, const std::string& reason) {
    const std::lock_guard lock(mutex_);
    MapEntry& entry = entries_[name];
    entry.state = LoadState::failed;
    entry.reason = reason;
}

void MapLibrary::remove(const std::string& name) {
    const std::lock_guard lock(mutex_);
    entries_.erase(name);
}

std::optional<MapEntry> MapLibrary::find(const std::string& name) const {
    const std::lock_guard lock(mutex_);
    const auto found = entries_.find(name);
    if (found == entries_.end()) return std::nullopt;
    return found->second;
}

std::vector<std::string> MapLibrary::names() const {
    const std::lock_guard lock(mutex_);
    std::vector<std::string> names;
    for (const auto& [name, entry] : entries_)
        names.push_back(name);
    return names;
}

std::map<std::string, MapEntry> MapLibrary::entries() const {
    const std::lock_guard lock(mutex_);
    return entries_;
}

}  // namespace camdir::director
