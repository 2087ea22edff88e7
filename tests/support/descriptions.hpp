// MatchInfo and ShownMatch say the same of a match: one from the other.
#pragma once

#include <camera_director.h>

#include <cstring>

namespace camdir::test {

// Its arrays and its map's name are `from`'s.
template <class To, class From>
[[nodiscard]] To described_as(const From& from) {
    const auto lend = [](auto& to, const auto& sequence) {
        to._buffer = sequence._buffer;
        to._length = to._maximum = sequence._length;
    };
    To to{};
    std::memcpy(to.match_id, from.match_id, sizeof to.match_id);
    to.epoch = from.epoch;
    to.map_name = from.map_name;
    to.map_hash = from.map_hash;
    to.metres_per_unit = from.metres_per_unit;
    to.rate_hz = from.rate_hz;
    to.spectator_delay_s = from.spectator_delay_s;
    lend(to.player_id, from.player_id);
    lend(to.player_name, from.player_name);
    lend(to.player_class, from.player_class);
    lend(to.player_team, from.player_team);
    return to;
}

}  // namespace camdir::test
