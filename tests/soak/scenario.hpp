// What happens in a run of chaos: a JSON file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "base/error.hpp"

namespace camdir::soak {

// What is done to a director, or by strangers; in JSON by the names in scenario.cpp.
enum class ActKind {
    kill,            // SIGKILL, and a new start after the act's duration
    terminate,       // SIGTERM, likewise
    pause,           // SIGSTOP, and SIGCONT after the act's duration
    hand_over,       // POST /hand-over
    reload,          // SIGHUP
    slow_observer,   // reads nothing any more, its process is stopped
    flapping_match,  // come and go
    unknown_map,     // a match on a map that nobody has
    wrong_hash,      // a match on another version of the map
    garbage_poses,   // no numbers, wrong lengths, too many players, far frame numbers
    backward_time,   // a match whose clocks run backwards
    usurper,         // claims a real match and its observers' requests
    flood_observers,
    flood_matches,
    passing_matches,  // come, are watched and go
    crowd,            // observers of the real matches that all connect at once
};

enum class Role { leader, standby };

struct Act {
    ActKind kind = ActKind::reload;
    double at_s = 0.0;             // after measuring begins
    double every_s = 0.0;          // 0 = once
    double for_s = 1.0;            // its duration
    Role director = Role::leader;  // to whom; of the first match
    std::int64_t count = 1000;     // of a crowd; of a flood or of passing matches, spread over its duration
    std::int64_t batch = 50;       // of these at a time; of a crowd, in one process
};

[[nodiscard]] std::string name_of(ActKind kind);
[[nodiscard]] bool is_done_to_director(ActKind kind);

struct Scenario {
    std::int64_t seed = 1;
    double seconds = 30.0;   // measured
    double settle_s = 5.0;   // without acts, at the end
    double warm_up_s = 0.0;  // with acts, and time to settle, before the level of memory is taken
    std::int64_t directors = 2;
    std::int64_t matches = 2;    // real ones
    std::int64_t players = 8;    // a match
    std::int64_t observers = 2;  // a match
    double rate_hz = 30.0;
    double delay_s = 0.0;
    std::vector<Act> acts;
};

// The error names every problem, one per line: JSON pointer, value, expectation.
[[nodiscard]] Result<Scenario> read_scenario(const std::filesystem::path& file);
// The same from text.
[[nodiscard]] Result<Scenario> parse_scenario(const std::string& text);

}  // namespace camdir::soak
