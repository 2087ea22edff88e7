// Read-only copies of the director's state, for metrics, status pages and logs.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "director/messages.hpp"
#include "freespace/freespace.hpp"

namespace camdir::director {

// What is counted since the director's start.
enum class Counter : std::size_t {
    match_infos,
    pose_frames,
    events,
    requests,
    camera_frames,
    cameras,
    cuts,
    searches,            // a camera began to search
    silences,            // a match's poses stopped, or its game server was lost
    drop_unknown_match,  // pose frames and events of matches without a MatchInfo
    drop_old_epoch,
    drop_early_epoch,  // of an epoch whose MatchInfo has not arrived yet
    drop_old_frame,    // frame number not greater than the previous one
    drop_superseded,   // a newer pose frame arrived before a worker was free
    drop_burst,        // of pose frames that something on the way had held up: too many came together, the
                       // next one came before they had a turn, or the pace is slower
    drop_paced,        // pose frames that were left out evenly: see Pace
    drop_rate,         // pose frames beyond limits.pose_rate_hz
    drop_waiting,      // pose frames of a match without a map
    drop_players,      // poses beyond limits.players, duplicate players
    drop_events,       // the match's queue of events was full
    drop_messages,     // too many wanted to view the match
    drop_delay,        // of a match whose delay is refused
    refused_matches,   // limits.matches
    refused_matches_delay,  // theirs is too long or needs too much memory
    refused_matches_map,    // theirs is not the one that was baked, and the map is strict
    refused_invalid,        // requests: what they ask for does not exist, or is not allowed
    refused_match,          // the match itself is refused
    refused_observers,      // limits.observers; some of them wait
    refused_shots,          // limits.shots
    refused_no_match,       // no game server runs the match, and observers wait for limits.matches others
    map_hash_mismatches,
    scale_mismatches,  // of metres_per_unit
    mover_frames,      // frames in which movers were elsewhere than before, or others
    unknown_movers,    // without a shape: of a model that the map does not have
    count
};
inline constexpr std::size_t counter_count = static_cast<std::size_t>(Counter::count);

// A histogram of durations. bounds_s are the buckets' inclusive upper bounds; the last bucket has none.
struct Durations {
    static constexpr std::array<double, 14> bounds_s = {2e-6, 5e-6, 1e-5, 2e-5, 5e-5, 1e-4, 2e-4,
                                                        5e-4, 1e-3, 2e-3, 5e-3, 1e-2, 5e-2, 0.25};
    std::array<std::uint64_t, bounds_s.size() + 1> buckets{};
    double sum_s = 0.0;
};

struct Statistics {
    std::array<std::uint64_t, counter_count> counters{};
    Durations step;  // one tracker step of one shot
    Durations
        latency;  // from the receipt of a pose frame, or when it is due, until its cameras are published
    // Its parts: until the match's turn comes to it, until its cameras are computed, until they are written.
    Durations waiting, computing, writing;
    std::uint64_t matches = 0;
    std::uint64_t silent_matches = 0;
    std::uint64_t observers = 0;
    std::uint64_t shots = 0;
    std::uint64_t delayed_bytes = 0;      // memory of what waits until it is due
    std::uint32_t frames_per_camera = 1;  // see Pace

    [[nodiscard]] std::uint64_t operator[](Counter counter) const {
        return counters[static_cast<std::size_t>(counter)];
    }
};

struct MatchStatistics {
    std::string match_id;
    Statistics statistics;  // without what belongs to no match
};

struct ShotView {
    std::uint32_t camera_id = 0;
    std::uint32_t target = no_player;  // the player followed now
    bool automatic = false;
    std::string profile;
    std::uint64_t observers = 0;
    std::uint32_t flags = 0;                // of the last camera
    Reason reason;                          // why the player is followed, of an automatic shot
    std::int64_t since = 0;                 // frame_time, likewise
    std::vector<std::uint32_t> group = {};  // of a group shot: its players
    std::uint32_t fixed = freespace::none;  // the fixed shot of the map that is shown instead of a player
    std::uint8_t team = 0;                  // of an automatic shot: whom it shows; 0: any
};

struct ObserverView {
    std::string observer_id;
    RequestState state = RequestState::refused;
    std::uint32_t camera_id = 0;
    std::string reason;
};

struct MatchView {
    std::string match_id;
    bool answered = false;  // false: no answer within the time allowed, the rest is empty
    std::uint64_t epoch = 0;
    std::string map_name;
    std::string state;     // "running", "waiting for map", "filling the delay", "silent", "game server lost",
                           // "no game server"
    float rate_hz = 0.0F;  // of the game server
    float camera_rate_hz = 0.0F;  // of the cameras: at most limits.pose_rate_hz, and a share, see Pace
    double delay_s = 0.0;         // in force: the greater of the match's own and the operator's
    std::vector<Player> players;  // as the game server lists them
    std::optional<MatchEvent> last_event;  // of this epoch
    std::uint32_t last_pose_number = 0;
    std::size_t movers = 0;                   // that are obstacles
    std::vector<std::string> unknown_movers;  // that are none: their models, or ids
    std::vector<ShotView> shots;
    std::vector<ObserverView> observers;
};

struct View {
    std::vector<MatchView> matches;  // by match_id
};

}  // namespace camdir::director
