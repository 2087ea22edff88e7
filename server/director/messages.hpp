// The director's input and output messages, independent of the transport. Whoever creates them has checked
// them: arrays agree in length, numbers are finite, quaternions have length 1. The fields are those of
// idl/camera_director.idl, which says what they mean.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/geometry.hpp"

namespace camdir::director {

inline constexpr std::uint32_t no_player = 0xffffffffU;    // as a target: the director chooses
inline constexpr std::uint32_t whole_group = 0xfffffffeU;  // as a target: the players of the group together
inline constexpr std::size_t max_players = 256;
inline constexpr std::size_t max_cameras = 256;

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

struct PlayerPose {
    std::uint32_t player_id = 0;
    Vec3f eye = Vec3f::Zero();
    Quatf orientation = Quatf::Identity();
    Vec3f velocity = Vec3f::Zero();
    std::uint32_t flags = 0;  // 1 alive, 2 discontinuity since the last frame, 4 spectator
    std::optional<std::uint32_t> discontinuities = {};  // in this epoch, modulo 2^32
};

struct PoseFrame {
    std::uint64_t epoch = 0;
    std::uint32_t frame_number = 0;
    std::int64_t frame_time = 0;   // ns, the game's clock within the epoch
    std::int64_t source_time = 0;  // ns, CLOCK_REALTIME of the sender
    std::vector<PlayerPose> poses;
};

// A pose frame that has arrived.
struct PoseArrival {
    std::string match_id;
    PoseFrame frame;
};

struct MatchEvent {
    std::uint64_t epoch = 0;
    std::int64_t frame_time = 0;
    std::uint32_t kind = 0;
    std::uint32_t actor = no_player;
    std::uint32_t subject = no_player;
    float value = 0.0F;
    std::string detail = {};
};

struct ObserverRequest {
    std::string match_id;
    std::string observer_id;
    std::uint32_t target = no_player;
    std::vector<std::uint32_t> group;
    std::string profile;
    std::string overrides;
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
