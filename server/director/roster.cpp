#include "director/roster.hpp"

#include <algorithm>
#include <utility>

namespace camdir::director {
namespace {

constexpr std::size_t max_known = 2 * max_players;

}  // namespace

void Roster::clear() {
    entries_.clear();
    frames_ = 0;
    changed_ = true;
}

const Roster::Entry* Roster::find(std::uint32_t player) const {
    const auto place =
        std::lower_bound(entries_.begin(), entries_.end(), player,
                         [](const Entry& entry, std::uint32_t id) { return entry.player < id; });
    return place != entries_.end() && place->player == player ? &*place : nullptr;
}

Roster::Entry* Roster::find_or_add(std::uint32_t player) {
    const auto place =
        std::lower_bound(entries_.begin(), entries_.end(), player,
                         [](const Entry& entry, std::uint32_t id) { return entry.player < id; });
    if (place != entries_.end() && place->player == player) return &*place;
    if (entries_.size() >= max_known) return nullptr;
    changed_ = true;
    return &*entries_.insert(place, Entry{player, false, 0, false, 0, nullptr});
}

void Roster::set_listed(std::span<const Player> players) {
    for (Entry& entry : entries_) {
        entry.listed = false;
        entry.team = 0;
    }
    for (const Player& player : players) {
        Entry* entry = find_or_add(player.id);
        if (entry == nullptr) continue;
        entry->listed = true;
        entry->team = player.team;
    }
    changed_ = true;
    // A player who is no longer listed and has no pose has left the match.
    std::erase_if(entries_, [&](const Entry& entry) { return !entry.listed && entry.pose == nullptr; });
}

std::uint64_t Roster::update(std::span<const PlayerPose> poses, std::int64_t max_absent_frames) {
    ++frames_;
    for (Entry& entry : entries_)
        entry.pose = nullptr;
    std::uint64_t skipped = 0;
    for (const PlayerPose& pose : poses) {
        Entry* entry = find_or_add(pose.player_id);
        if (entry == nullptr || entry->last_seen == frames_) {
            ++skipped;
            continue;
        }
        const bool spectator = (pose.flags & pose_spectator) != 0;
        changed_ = changed_ || spectator != entry->spectator;
        entry->spectator = spectator;
        entry->last_seen = frames_;
        entry->pose = &pose;
    }
    forget_absent(max_absent_frames);
    return skipped;
}

void Roster::forget_absent(std::int64_t max_absent_frames) {
    const auto absent = [&](const Entry& entry) {
        return !entry.listed && frames_ - entry.last_seen > max_absent_frames;
    };
    if (std::erase_if(entries_, absent) > 0) changed_ = true;
}

bool Roster::take_changed() {
    return std::exchange(changed_, false);
}

Presence Roster::presence(std::uint32_t player) const {
    const Entry* entry = find(player);
    if (entry == nullptr) return Presence::unknown;
    return entry->spectator ? Presence::spectator : Presence::playing;
}

bool Roster::anyone_playing(std::uint8_t team) const {
    return std::any_of(entries_.begin(), entries_.end(), [&](const Entry& entry) {
        return !entry.spectator && (team == 0 || entry.team == team);
    });
}

std::uint8_t Roster::team(std::uint32_t player) const {
    const Entry* entry = find(player);
    return entry == nullptr ? std::uint8_t{0} : entry->team;
}

const PlayerPose* Roster::pose(std::uint32_t player) const {
    const Entry* entry = find(player);
    return entry == nullptr || entry->spectator ? nullptr : entry->pose;
}

}  // namespace camdir::director
