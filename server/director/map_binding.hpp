// The map that a match is played on.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "director/counters.hpp"
#include "director/map_library.hpp"
#include "director/messages.hpp"

namespace camdir::director {

// Finds a match's map in the library, and compares it with what the game server says of it. What does not
// agree is logged and counted, again when it changes. One thread at a time; `maps` and `counters` must
// outlive it.
class MapBinding {
  public:
    MapBinding(std::string match_id, const MapLibrary& maps, MatchCounters& counters)
        : match_id_(std::move(match_id)), maps_(maps), counters_(counters) {}

    // Takes the match's map as it is in the library now. Returns true when it is another one than before, or
    // there is none.
    bool bind(const MatchInfo& info);
    // No game server runs the match.
    void release();

    // Null: there is none. Valid until bind() returns true, or release().
    [[nodiscard]] const freespace::Freespace* freespace() const {
        return freespace_ ? &*freespace_ : nullptr;
    }
    // Why there is none; empty when there is.
    [[nodiscard]] const std::string& missing() const { return missing_; }
    // Why the match must not be served on it: the map is strict, and the game server's is another file. Empty
    // when it may.
    [[nodiscard]] const std::string& refusal() const { return refusal_; }

    // Movers of the match that are no obstacles on this map: MatchObstacles::unknown().
    void report_unknown_movers(const std::vector<std::string>& unknown);

  private:
    static constexpr const char* no_server = "no game server runs this match";

    bool wait(std::string reason);  // returns what bind() returns
    void check_hash(const MatchInfo& info, const MapEntry& entry);
    void check_scale(const MatchInfo& info, const MapEntry& entry);

    const std::string match_id_;
    const MapLibrary& maps_;
    MatchCounters& counters_;

    std::optional<freespace::Freespace> freespace_;
    std::string missing_ = no_server;
    std::string refusal_;
    std::uint64_t generation_ = 0;  // of the freespace
    std::string name_;              // of the map

    // What was reported last.
    std::pair<std::uint64_t, std::uint64_t> hashes_;  // the game server's, the baked map's
    std::pair<float, float> scales_;                  // metres per unit, likewise
    std::vector<std::string> unknown_movers_;
};

}  // namespace camdir::director
