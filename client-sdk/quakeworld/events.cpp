#include "events.hpp"

#include <cstdlib>

namespace camdir::qtv {
namespace {

using Kind = quakeworld::Occurrence::Kind;

std::uint32_t id_of(const std::optional<quakeworld::Slot>& slot) {
    return slot ? *slot : CDIR_NO_PLAYER;
}

// The game gives a point for an enemy, and takes one for oneself or a team mate.
void set_kill(camera_director::MatchEvent& event) {
    const bool by_oneself = event.detail == "self";
    if (by_oneself) event.actor = event.subject;
    if (event.actor == CDIR_NO_PLAYER) return;
    event.value = by_oneself || event.detail == "team" ? -1.0F : 1.0F;
}

}  // namespace

camera_director::MatchEvent event_of(const quakeworld::Occurrence& occurrence, std::uint32_t round) {
    camera_director::MatchEvent event;
    event.frame_time = occurrence.time * ns_of_a_ms;
    event.actor = id_of(occurrence.actor);
    event.subject = id_of(occurrence.subject);
    event.detail = occurrence.detail;
    switch (occurrence.kind) {
        case Kind::obituary:
            event.kind = CDIR_EVENT_KILL;
            set_kill(event);
            break;
        case Kind::damage:
            event.kind = CDIR_EVENT_DAMAGE;
            event.value = std::strtof(occurrence.detail.c_str(), nullptr);
            event.detail.clear();
            break;
        case Kind::item:
            event.kind = CDIR_EVENT_ITEM;
            break;
        case Kind::match_begin:
        case Kind::match_end:
            event.kind = CDIR_EVENT_ROUND;
            event.value = static_cast<float>(round);
            event.detail = occurrence.kind == Kind::match_begin ? "begin" : "end";
            break;
    }
    return event;
}

}  // namespace camdir::qtv
