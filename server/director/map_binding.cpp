#include "director/map_binding.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace camdir::director {
namespace {

constexpr float scale_tolerance = 1e-3F;  // relative: games state rounded lengths

std::string joined(const std::vector<std::string>& names) {
    std::string list;
    for (const std::string& name : names)
        list += (list.empty() ? "" : ", ") + name;
    return list.empty() ? "none" : list;
}

// Of names that others have given, for a line of the log.
std::string some_of(const std::vector<std::string>& names) {
    constexpr std::size_t most = 8;
    std::string list =
        joined({names.begin(), names.begin() + static_cast<std::ptrdiff_t>(std::min(names.size(), most))});
    std::ranges::replace_if(
        list, [](unsigned char c) { return c < 0x20 || c == 0x7f; }, '?');
    return names.size() > most ? list + " and others" : list;
}

}  // namespace

bool MapBinding::bind(const MatchInfo& info) {
    name_ = info.map_name;
    refusal_.clear();
    const std::string named = "map '" + name_ + "'";
    const auto entry = maps_.find(name_);
    if (!entry) return wait(named + " is not configured; known: " + joined(maps_.names()));
    if (!entry->freespace)
        return wait(named + (entry->state == LoadState::failed ? " failed" : " is loading") +
                    (entry->reason.empty() ? "" : ": " + entry->reason));
    check_hash(info, *entry);
    check_scale(info, *entry);
    missing_.clear();
    if (freespace_ && entry->generation == generation_) return false;
    freespace_ = entry->freespace;
    generation_ = entry->generation;
    unknown_movers_.clear();  // another map has others
    return true;
}

void MapBinding::release() {
    missing_ = no_server;
    refusal_.clear();
    freespace_.reset();
}

bool MapBinding::wait(std::string reason) {
    if (reason != missing_) spdlog::warn("match {}: no cameras: {}", match_id_, reason);
    missing_ = std::move(reason);
    freespace_.reset();
    return true;
}

void MapBinding::check_hash(const MatchInfo& info, const MapEntry& entry) {
    const std::uint64_t baked = entry.freespace->metadata().source_hash;
    if (info.map_hash == 0 || baked == 0 || info.map_hash == baked) return;
    const std::pair mismatch(info.map_hash, baked);
    if (std::exchange(hashes_, mismatch) != mismatch) {
        counters_.add(Counter::map_hash_mismatches);
        spdlog::warn("match {}: its map file {} (xxh3 {:016x}) is not the one that was baked ({:016x})",
                     match_id_, name_, info.map_hash, baked);
    }
    if (entry.strict) refusal_ = "the game server's map '" + name_ + "' is not the one that was baked";
}

// The cameras keep the map's scale; observers convert positions by the game server's.
void MapBinding::check_scale(const MatchInfo& info, const MapEntry& entry) {
    const float sent = info.metres_per_unit;
    const float baked = entry.freespace->metadata().metres_per_unit;
    if (sent == 0.0F || std::abs(sent - baked) <= scale_tolerance * baked) return;
    const std::pair mismatch(sent, baked);
    if (std::exchange(scales_, mismatch) == mismatch) return;
    counters_.add(Counter::scale_mismatches);
    spdlog::warn(
        "match {}: its game server says {} metres per unit, map {} was baked with {}: distances "
        "differ between observers and cameras",
        match_id_, sent, name_, baked);
}

void MapBinding::report_unknown_movers(const std::vector<std::string>& unknown) {
    if (unknown == unknown_movers_) return;
    unknown_movers_ = unknown;
    counters_.add(Counter::unknown_movers, unknown.size());
    if (unknown.empty()) return;
    spdlog::warn(
        "match {}: {} of its movers are no obstacles: map {} has no such model, and they have no shape of "
        "their own: {}",
        match_id_, unknown.size(), name_, some_of(unknown));
}

}  // namespace camdir::director
