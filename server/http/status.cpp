#include "http/status.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>

#include "config/json_text.hpp"
#include "live/notes.hpp"

namespace camdir::http {
namespace {

using json = nlohmann::ordered_json;

json page_of(const director::Player& player) {
    return {{"id", player.id}, {"name", player.name}, {"class", player.player_class}, {"team", player.team}};
}

// Null for nobody; of players whom the game server does not list, the id is all that is known.
json page_of(std::uint32_t player, const std::vector<director::Player>& players) {
    if (player == director::no_player) return nullptr;
    const auto listed = std::ranges::find(players, player, &director::Player::id);
    return listed == players.end() ? json{{"id", player}} : page_of(*listed);
}

json page_of(const director::MatchEvent& event, const std::vector<director::Player>& players) {
    json page = {{"kind", event.kind},
                 {"actor", page_of(event.actor, players)},
                 {"subject", page_of(event.subject, players)},
                 {"value", event.value},
                 {"detail", event.detail}};
    if (const auto name = director::name_of(event)) page["kind"] = *name;
    return page;
}

json page_of(const director::Reason& reason, const std::vector<director::Player>& players) {
    return {{"why", reason.why},
            {"actor", page_of(reason.actor, players)},
            {"subject", page_of(reason.subject, players)}};
}

json page_of(const director::ShotView& shot, const std::vector<director::Player>& players) {
    json page = {{"camera_id", shot.camera_id},
                 {"automatic", shot.automatic},
                 {"profile", shot.profile},
                 {"observers", shot.observers},
                 {"flags", shot.flags}};
    page["target"] = page_of(shot.target, players);
    page["group"] = json::array();
    for (const std::uint32_t player : shot.group)
        page["group"].push_back(page_of(player, players));
    page["reason"] = shot.automatic && !shot.reason.why.empty() ? page_of(shot.reason, players) : json();
    page["team"] = shot.team == 0 ? json() : json(shot.team);
    page["fixed_shot"] = shot.fixed == freespace::none ? json() : json(shot.fixed);
    page["since"] = shot.automatic ? json(shot.since) : json();
    return page;
}

json page_of(const director::ObserverView& observer) {
    static constexpr const char* states[] = {"refused", "accepted", "waiting for map", "waiting for player"};
    return {{"observer_id", observer.observer_id},
            {"state", states[static_cast<std::size_t>(observer.state)]},
            {"camera_id", observer.camera_id},
            {"reason", observer.reason}};
}

json page_of(const director::MatchView& match) {
    if (!match.answered) return {{"match_id", match.match_id}, {"state", "no answer"}};
    json page = {{"match_id", match.match_id}, {"state", match.state},
                 {"epoch", match.epoch},       {"map", match.map_name},
                 {"rate_hz", match.rate_hz},   {"camera_rate_hz", match.camera_rate_hz},
                 {"delay_s", match.delay_s},   {"last_pose_number", match.last_pose_number},
                 {"movers", match.movers},     {"unknown_movers", match.unknown_movers},
                 {"players", json::array()},   {"shots", json::array()},
                 {"observers", json::array()}};
    for (const auto& player : match.players)
        page["players"].push_back(page_of(player));
    page["last_event"] = match.last_event ? page_of(*match.last_event, match.players) : json();
    for (const auto& shot : match.shots)
        page["shots"].push_back(page_of(shot, match.players));
    for (const auto& observer : match.observers)
        page["observers"].push_back(page_of(observer));
    return page;
}

json page_of(const std::string& name, const director::MapEntry& map) {
    static constexpr const char* states[] = {"loading", "ready", "failed"};
    json page = {
        {"name", name}, {"state", states[static_cast<std::size_t>(map.state)]}, {"reason", map.reason}};
    if (map.freespace) {
        page["vertices"] = map.freespace->vertices().size();
        page["triangles"] = map.freespace->triangles().size();
        page["bytes"] = map.freespace->byte_size();
    }
    return page;
}

}  // namespace

std::string status_page(const director::View& view, const std::map<std::string, director::MapEntry>& maps,
                        const std::function<bool(const std::string&)>& leads) {
    json page = {{"maps", json::array()}, {"matches", json::array()}};
    for (const auto& [name, map] : maps)
        page["maps"].push_back(page_of(name, map));
    for (const auto& match : view.matches)
        page["matches"].emplace_back(page_of(match))["leads"] = leads(match.match_id);
    return config::format_json(page);
}

std::string live_page(const director::View& view, bool broadcasts) {
    json page = {{"version", live::protocol_version}, {"matches", json::array()}};
    if (broadcasts) page["broadcast"] = "/broadcast";
    for (const auto& match : view.matches) {
        if (!match.answered || match.map_name.empty()) continue;
        json entry = page_of(match);
        for (const char* key : {"observers", "last_event", "last_pose_number", "movers", "unknown_movers"})
            entry.erase(key);
        page["matches"].push_back(std::move(entry));
    }
    return config::format_json(page);
}

}  // namespace camdir::http
