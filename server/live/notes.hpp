// The notes of idl/live.md: what a viewer is told as JSON text.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>

#include "director/messages.hpp"
#include "live/frame.hpp"
#include "live/history.hpp"
#include "live/viewer.hpp"

namespace camdir::live {

inline constexpr int protocol_version = 1;

struct Place {  // of a player in the frames
    director::Player player;
    bool listed = false;  // by the game server; else the id is all that is known
};
using Roster = std::map<std::uint8_t, Place>;  // by slot

[[nodiscard]] SharedMessage match_note(const director::MatchInfo& match, const Roster& roster);
// Follows the match for who has just joined.
[[nodiscard]] SharedMessage history_note(const History& history, const SlotOf& slot_of);
// Precedes the frames that have them.
[[nodiscard]] SharedMessage movers_note(std::span<const director::Mover> movers);
[[nodiscard]] SharedMessage event_note(const director::MatchEvent& event, const SlotOf& slot_of);
[[nodiscard]] SharedMessage cut_note(const Cut& cut, const SlotOf& slot_of);
[[nodiscard]] SharedMessage dropped_note(std::size_t frames);
enum class EndReason {
    match,   // it has ended
    server,  // it stops; the match may go on
};
[[nodiscard]] SharedMessage end_note(EndReason reason);

}  // namespace camdir::live
