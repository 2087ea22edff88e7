#include "live/notes.hpp"

#include <array>
#include <charconv>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "live/map_contents.hpp"

namespace camdir::live {
namespace {

using json = nlohmann::ordered_json;

// Names may hold any bytes; text of WebSockets is UTF-8.
SharedMessage note(const json& content) {
    return std::make_shared<Message>(
        Message{Message::Kind::note, content.dump(-1, ' ', false, json::error_handler_t::replace)});
}

json slot_json(std::uint32_t player, const SlotOf& slot_of) {
    const std::uint8_t slot = slot_of(player);
    return slot == no_slot ? json() : json(slot);
}

// Milliseconds of the match's clock.
double milliseconds(std::int64_t nanoseconds) {
    return static_cast<double>(nanoseconds / 1000) / 1000.0;
}

void append_number(std::string& text, double number) {
    std::array<char, 32> digits{};
    const auto [end, error] = std::to_chars(digits.begin(), digits.end(), number, std::chars_format::fixed);
    text.append(digits.begin(), error == std::errc() ? end : digits.begin());
}

}  // namespace

SharedMessage match_note(const director::MatchInfo& match, const Roster& roster) {
    json players = json::array();
    for (const auto& [slot, place] : roster) {
        players.push_back({{"slot", slot}, {"id", place.player.id}, {"listed", place.listed}});
        if (place.listed)
            players.back().update({{"name", place.player.name},
                                   {"class", place.player.player_class},
                                   {"team", place.player.team}});
    }
    return note({{"kind", "match"},
                 {"version", protocol_version},
                 {"match_id", match.match_id},
                 {"epoch", match.epoch},
                 {"map", match.map_name},
                 {"metres_per_unit", match.metres_per_unit},
                 {"position_step", position_step(match.metres_per_unit)},
                 {"rate_hz", match.rate_hz},
                 {"players", players}});
}

// By hand, because the match waits for it: a JSON library takes ten times as long.
SharedMessage history_note(const History& history, const SlotOf& slot_of) {
    std::string text = R"({"kind":"history","states":[)";
    for (const ShotState& state : history.states()) {
        const std::uint8_t slot = slot_of(state.target);
        text += text.back() == ']' ? ",[" : "[";
        append_number(text, milliseconds(state.frame_time));
        text += ',' + std::to_string(state.camera_id) + ',';
        text += slot == no_slot ? "null" : std::to_string(slot);
        text += ',' + (state.present ? std::to_string(state.flags) : "null") + ']';
    }
    text += R"(],"notes":[)";
    for (const auto* kept : {&history.cuts(), &history.events()})
        for (const SharedMessage& note : *kept) {
            if (text.back() == '}') text += ',';
            text += note->content;
        }
    return std::make_shared<Message>(Message{Message::Kind::note, text + "]}"});
}

SharedMessage movers_note(std::span<const director::Mover> movers) {
    json content = {{"kind", "movers"}, {"movers", json::array()}};
    for (const director::Mover& mover : movers) {
        json entry = {{"id", mover.id}};
        entry.update(mover_json(mover.shape));
        content["movers"].push_back(std::move(entry));
    }
    return note(content);
}

SharedMessage event_note(const director::MatchEvent& event, const SlotOf& slot_of) {
    json content = {{"kind", "event"},
                    {"t", milliseconds(event.frame_time)},
                    {"event", event.kind},
                    {"actor", slot_json(event.actor, slot_of)},
                    {"subject", slot_json(event.subject, slot_of)},
                    {"value", event.value},
                    {"detail", event.detail}};
    if (const auto name = director::name_of(event)) content["event"] = *name;
    return note(content);
}

SharedMessage cut_note(const Cut& cut, const SlotOf& slot_of) {
    static constexpr std::array reasons = {"begin", "target", "moved", "hidden", "viewpoint"};
    json content = {{"kind", "cut"},
                    {"t", milliseconds(cut.frame_time)},
                    {"camera", cut.camera_id},
                    {"target", slot_json(cut.target, slot_of)},
                    {"reason", reasons[static_cast<std::size_t>(cut.reason)]}};
    if (cut.moment)
        content["moment"] = {{"rule", cut.moment->why},
                             {"actor", slot_json(cut.moment->actor, slot_of)},
                             {"subject", slot_json(cut.moment->subject, slot_of)}};
    return note(content);
}

SharedMessage dropped_note(std::size_t frames) {
    return note({{"kind", "dropped"}, {"frames", frames}});
}

SharedMessage end_note(EndReason reason) {
    return note({{"kind", "end"}, {"reason", reason == EndReason::match ? "match" : "server"}});
}

}  // namespace camdir::live
