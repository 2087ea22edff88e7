#include "live/models.hpp"

#include <spdlog/spdlog.h>
#include <xxhash.h>

#include <algorithm>
#include <array>
#include <cstdio>

#include "export/glb.hpp"
#include "live/gzip.hpp"
#include "live/map_contents.hpp"
#include "maps/source.hpp"

namespace camdir::live {
namespace {

Models::Answer compressed(std::span<const std::byte> content) {
    auto model = std::make_shared<Model>();
    model->gzip = gzip(content);
    std::array<char, 20> tag{};
    std::snprintf(tag.data(), tag.size(), "%016llx",
                  static_cast<unsigned long long>(XXH3_64bits(model->gzip.data(), model->gzip.size())));
    model->tag = tag.data();
    return {std::move(model), {}, {}};
}

std::span<const std::byte> as_bytes(std::string_view text) {
    return std::as_bytes(std::span(text));
}

Models::Answer compressed(const Result<Bytes>& glb) {
    if (!glb) return {nullptr, Models::Failure::no_source, glb.error().message};
    return compressed(std::span<const std::byte>(*glb));
}

Models::Answer without_source(std::string reason) {
    return {nullptr, Models::Failure::no_source, std::move(reason)};
}

}  // namespace

void Models::set_source(const std::string& map, const std::string& source) {
    const std::lock_guard lock(mutex_);
    sources_[map] = source;
}

void Models::remove_source(const std::string& map) {
    const std::lock_guard lock(mutex_);
    sources_.erase(map);
}

Models::Answer Models::find(const std::string& map, ModelKind kind, Clock::time_point now) {
    const auto entry = maps_.find(map);
    if (!entry || !entry->freespace) return {};
    const Key key{map, entry->generation, kind};
    if (const auto known = look_up(key, now)) return *known;
    std::unique_lock making(making_, std::defer_lock);
    if (kind != ModelKind::contents && !making.try_lock()) return {nullptr, Failure::busy, {}};
    if (const auto known = look_up(key, now)) return *known;  // made until now
    Answer answer = make(*entry, map, kind);
    keep(key, answer, now);
    return answer;
}

Models::Answer Models::make(const director::MapEntry& map, const std::string& name, ModelKind kind) {
    switch (kind) {
        case ModelKind::mesh:
            return compressed(exports::to_glb(*map.freespace));
        case ModelKind::contents:
            return compressed(as_bytes(map_contents(*map.freespace)));
        case ModelKind::obstacles:
            break;
    }
    return make_obstacles(map, name);
}

// Reasons name no file: whoever opens the page reads them. The log does.
Models::Answer Models::make_obstacles(const director::MapEntry& map, const std::string& name) {
    std::string source;
    {
        const std::lock_guard lock(mutex_);
        const auto found = sources_.find(name);
        if (found != sources_.end()) source = found->second;
    }
    if (source.empty()) return without_source("no source of this map is named");
    const auto scene = maps::load_source(*map.freespace, source);
    if (!scene) {
        spdlog::warn("live: map {}: {}", name, scene.error().message);
        return without_source("the map's source cannot be read");
    }
    if (scene->source_hash != map.freespace->metadata().source_hash)
        return without_source("the map was baked from another version of its source");
    if (scene->triangles.empty()) return without_source("the map's source has no surfaces");
    if (scene->triangles.size() > max_triangles)
        return without_source("the map's source has more than " + std::to_string(max_triangles) +
                              " triangles");
    return compressed(exports::to_glb(*scene));
}

std::optional<Models::Answer> Models::look_up(const Key& key, Clock::time_point now) {
    constexpr std::chrono::minutes refused_for{1};
    const std::lock_guard lock(mutex_);
    const auto found = std::ranges::find(kept_, key, &Kept::key);
    if (found == kept_.end()) return std::nullopt;
    if (!found->answer.model && now - found->made_at > refused_for) return std::nullopt;
    kept_.splice(kept_.begin(), kept_, found);
    return kept_.front().answer;
}

void Models::keep(const Key& key, const Answer& answer, Clock::time_point now) {
    constexpr std::size_t entry_bytes = 1024;
    const std::lock_guard lock(mutex_);
    std::erase_if(kept_, [&](const Kept& kept) {
        return kept.key == key || (kept.key.map == key.map && kept.key.generation != key.generation);
    });
    kept_.push_front({key, answer, now});
    std::size_t bytes = 0;
    const auto beyond = std::ranges::find_if(kept_, [&](const Kept& kept) {
        bytes += entry_bytes + (kept.answer.model ? kept.answer.model->gzip.size() : 0);
        return bytes > max_bytes;
    });
    kept_.erase(beyond, kept_.end());
}

}  // namespace camdir::live
