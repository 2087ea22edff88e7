// The director's input and output messages, independent of the transport. Whoever creates them has checked
// them: arrays agree in length, numbers are finite, quaternions have length 1. The fields are those of
// idl/camera_director.idl, which says what they mean.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/geometry.hpp"
#include "freespace/mover_shape.hpp"

namespace camdir::director {

inline constexpr std::uint32_t no_player = 0xffffffffU;    // as a target: the director chooses
inline constexpr std::uint32_t whole_group = 0xfffffffeU;  // as a target: the players of the group together
// Those two are nobody's.
[[nodiscard]] constexpr bool is_player_id(std::uint32_t id) {
    return id < whole_group;
}
inline constexpr std::size_t max_players = 256;
inline constexpr std::size_t max_cameras = 256;
// Of all movers of a match together: enough for its vehicles, and checked in milliseconds.
inline constexpr std::size_t max_half_spaces = 2048;
inline constexpr std::size_t max_balls = 2048;

struct Player {
    std::uint32_t id = 0;
    std::string name;
    std::string player_class;
    std::uint8_t team = 0;

    bool operator==(const Player&) const = default;
};

struct MatchInfo {
    std::string match_id;
    std::uint64_t epoch = 0;
    std::string map_name;
    std::uint64_t map_hash = 0;  // xxh3-64 of the map file; 0 = unknown
    float metres_per_unit = 1.0F;
    float rate_hz = 0.0F;
    float spectator_delay_s = 0.0F;
    std::vector<Player> players;

    bool operator==(const MatchInfo&) const = default;
};

// Flags of a PlayerPose.
inline constexpr std::uint32_t pose_alive = 1;
inline constexpr std::uint32_t pose_discontinuity = 2;  // a respawn or teleport since the last frame
inline constexpr std::uint32_t pose_spectator = 4;

struct PlayerPose {
    std::uint32_t player_id = 0;
    Vec3f eye = Vec3f::Zero();
    Quatf orientation = Quatf::Identity();
    Vec3f velocity = Vec3f::Zero();
    std::uint32_t flags = 0;
    std::optional<std::uint32_t> discontinuities = {};  // in this epoch, modulo 2^32
};

// A moving obstacle as the game server describes it: `shape.name` is a model of the map, or empty; its own
// hulls, with bounds, and balls count where the map has no such model.
struct Mover {
    std::uint32_t id = 0;
    freespace::MoverShape shape;

    bool operator==(const Mover&) const = default;
};

struct MoverInfo {
    std::uint64_t epoch = 0;
    std::vector<Mover> movers;

    bool operator==(const MoverInfo&) const = default;
};

struct MoverPose {
    std::uint32_t mover_id = 0;
    Vec3f position = Vec3f::Zero();
    Quatf orientation = Quatf::Identity();
};

struct MoverFrame {
    std::uint64_t epoch = 0;
    std::int64_t frame_time = 0;
    std::int64_t source_time = 0;
    std::vector<MoverPose> poses;
};

// The movers as of one pose frame, of its epoch. Both are never null.
struct MatchMovers {
    std::shared_ptr<const MoverInfo> info;
    std::shared_ptr<const MoverFrame> frame;
};

struct PoseFrame {
    std::uint64_t epoch = 0;
    std::uint32_t frame_number = 0;
    std::int64_t frame_time = 0;   // ns, the game's clock within the epoch
    std::int64_t source_time = 0;  // ns, CLOCK_REALTIME of the sender
    std::vector<PlayerPose> poses;
    // Null: the match has none. The same object as before where nothing has changed.
    std::shared_ptr<const MatchMovers> movers = {};
};

// A pose frame that has arrived.
struct PoseArrival {
    std::string match_id;
    PoseFrame frame;
};

// Of events that the director knows; others are carried along.
enum class MatchEventKind : std::uint32_t {
    kill = 1,
    flag_taken,
    flag_captured,
    objective,
    damage,
    award,
    item,
    round,
    spawn,
    weapon,
};
// Their names, from the first kind on.
inline constexpr std::array<std::string_view, 10> match_event_names = {
    "kill",  "flag taken", "flag captured", "objective", "damage",
    "award", "item",       "round",         "spawn",     "weapon"};
static_assert(match_event_names.size() == static_cast<std::size_t>(MatchEventKind::weapon));

struct MatchEvent {
    std::uint64_t epoch = 0;
    std::int64_t frame_time = 0;
    std::uint32_t kind = 0;  // a MatchEventKind, or any other number
    std::uint32_t actor = no_player;
    std::uint32_t subject = no_player;
    float value = 0.0F;
    std::string detail = {};
};

// None: of a kind that the director does not know.
[[nodiscard]] inline std::optional<std::string_view> name_of(const MatchEvent& event) {
    const std::size_t index = std::size_t{event.kind} - 1;
    return event.kind != 0 && index < match_event_names.size() ? std::optional(match_event_names[index])
                                                               : std::nullopt;
}

// As tables of events call it: "flag_taken", or the number of a kind that the director does not know.
[[nodiscard]] inline std::string table_name_of(const MatchEvent& event) {
    const auto known = name_of(event);
    std::string name = known ? std::string(*known) : std::to_string(event.kind);
    std::ranges::replace(name, ' ', '_');
    return name;
}

// The kind that tables of events call so, or, as some games do, "respawn" or "death": a kill by nobody. None
// of others.
[[nodiscard]] inline std::optional<MatchEventKind> event_kind_named(std::string_view table_name) {
    if (table_name == "respawn") return MatchEventKind::spawn;
    if (table_name == "death") return MatchEventKind::kill;
    const auto same = [](char a, char b) { return a == b || (a == ' ' && b == '_'); };
    for (std::uint32_t kind = 1; kind <= match_event_names.size(); ++kind)
        if (std::ranges::equal(match_event_names[kind - 1], table_name, same))
            return static_cast<MatchEventKind>(kind);
    return {};
}

struct ObserverRequest {
    std::string match_id;
    std::string observer_id;
    std::uint32_t target = no_player;
    std::vector<std::uint32_t> group;
    std::string profile;
    std::string overrides;
    std::uint8_t team = 0;  // of whom an automatic shot shows; 0: any

    bool operator==(const ObserverRequest&) const = default;
};

enum class RequestState : std::uint32_t {
    refused = 0,
    accepted = 1,
    waiting_for_map = 2,
    waiting_for_player = 3
};

struct ObserverStatus {
    std::string match_id;
    std::string observer_id;
    std::uint64_t epoch = 0;
    RequestState state = RequestState::refused;
    std::uint32_t camera_id = 0;
    std::string reason;  // at most 255 bytes

    bool operator==(const ObserverStatus&) const = default;
};

struct ShotCamera {
    std::uint32_t camera_id = 0;
    std::uint32_t target = no_player;
    Vec3f position = Vec3f::Zero();
    Quatf orientation = Quatf::Identity();
    float vertical_fov = 0.0F;
    float clearance = 0.0F;
    std::uint32_t flags = 0;
};

// Why an automatic shot began.
struct Reason {
    std::uint32_t actor = no_player;
    std::uint32_t subject = no_player;
    std::string why = {};  // the name of a moment's rule, or as direction::name_of; at most 31 bytes
};

struct ShotReason {
    std::uint32_t camera_id = 0;
    Reason reason;
};

struct CameraFrame {
    std::uint64_t epoch = 0;
    std::uint32_t frame_number = 0;  // on the wire it goes on from a leader's
    std::uint32_t pose_number = 0;
    std::int64_t frame_time = 0;
    std::int64_t source_time = 0;
    std::vector<ShotCamera> cameras;
    std::vector<ShotReason> reasons =
        {};  // of automatic shots that begin with this frame; of all once a second
};

}  // namespace camdir::director
