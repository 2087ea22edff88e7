#include "checks.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <set>
#include <vector>

#include "failure.hpp"
#include "idl/security.hpp"

namespace camdir::sdk {

namespace {

constexpr float pi = 3.14159265F;
constexpr float max_abs_position = 1e9F;  // map units: what is computed from such is finite
// 2^61 ns = 73 years: differences of such times do not overflow.
constexpr std::int64_t max_abs_time = std::int64_t{1} << 61U;

bool is_time(std::int64_t ns) {
    return -max_abs_time <= ns && ns <= max_abs_time;
}

bool has_control_character(const std::string& text) {
    return std::any_of(text.begin(), text.end(),
                       [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; });
}

void check_player(const cdir_player& player) {
    require(std::all_of(std::begin(player.reserved), std::end(player.reserved),
                        [](auto byte) { return byte == 0; }),
            "a player's reserved bytes are not 0");
    (void)checked_string("a player's name", player.name, 0, sizeof player.name - 1);
    (void)checked_string("a player's class", player.player_class, 0, sizeof player.player_class - 1);
}

bool finite(const dds_sequence_float& sequence) {
    return all_finite(sequence._buffer, sequence._length);
}

bool is_in_reach(const dds_sequence_float& positions) {
    return std::all_of(positions._buffer, positions._buffer + positions._length,
                       [](float x) { return std::abs(x) <= max_abs_position; });
}

// Names, classes and teams are given for all players or for none.
template <class Sequence>
bool is_parallel(const Sequence& sequence, std::uint32_t count) {
    return sequence._length == 0 || sequence._length == count;
}

}  // namespace

void require(bool condition, const char* text) {
    if (!condition) throw Failure{CDIR_INVALID_ARGUMENT, text};
}

std::string checked_string(const char* field, const char* text, std::size_t min_bytes,
                           std::size_t max_bytes) {
    if (text == nullptr) throw Failure{CDIR_INVALID_ARGUMENT, std::string(field) + " is null"};
    const std::size_t length = strnlen(text, max_bytes + 1);
    if (length < min_bytes || length > max_bytes) {
        throw Failure{CDIR_INVALID_ARGUMENT, std::string(field) + " must have " + std::to_string(min_bytes) +
                                                 " to " + std::to_string(max_bytes) +
                                                 " bytes before its zero byte"};
    }
    return {text, length};
}

std::string checked_match_id(const char* text) {
    std::string id = checked_string("match_id", text, 1, 63);
    require(id.find_first_of("/*?") == std::string::npos && !has_control_character(id),
            "match_id must not contain '/', '*', '?' or control characters");
    return id;
}

std::string checked_observer_id(const char* text) {
    std::string id = checked_string("observer_id", text, 1, 63);
    require(!has_control_character(id), "observer_id must not contain control characters");
    return id;
}

void check_frame_time(std::int64_t frame_time) {
    require(is_time(frame_time), "frame_time must be within 73 years of 0");
}

void check_identity(const std::string& folder) {
    require(!folder.empty(), "security is empty: expected the folder of an identity, or null for plain DDS");
    const std::string problem = wire::identity_problem(folder);
    require(problem.empty(), ("security: " + problem).c_str());
}

void check(const cdir_match_info& info, std::span<const cdir_player> players) {
    (void)checked_string("map_name", info.map_name, 1, sizeof info.map_name - 1);
    require(std::isfinite(info.metres_per_unit) && info.metres_per_unit > 0.0F,
            "metres_per_unit must be greater than 0");
    require(std::isfinite(info.rate_hz) && info.rate_hz > 0.0F, "rate_hz must be greater than 0");
    require(std::isfinite(info.spectator_delay_s) && info.spectator_delay_s >= 0.0F,
            "spectator_delay_s must be 0 or greater");
    std::vector<std::uint32_t> ids;
    for (const cdir_player& player : players) {
        check_player(player);
        ids.push_back(player.id);
    }
    check_player_ids(ids);
}

void check_player_ids(std::span<const std::uint32_t> ids) {
    require(std::all_of(ids.begin(), ids.end(), [](std::uint32_t id) { return id < CDIR_SHOW_GROUP; }),
            "a player's id is CDIR_SHOW_GROUP or CDIR_NO_PLAYER");
    // As most give them: nothing is allocated for a frame.
    if (std::adjacent_find(ids.begin(), ids.end(), std::greater_equal()) == ids.end()) return;
    const std::set<std::uint32_t> different(ids.begin(), ids.end());
    require(different.size() == ids.size(), "two players have the same id");
}

bool all_finite(const float* values, std::size_t count) {
    return std::all_of(values, values + count, [](float value) { return std::isfinite(value); });
}

bool all_unit(const float* quaternions, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
        double square = 0.0;
        for (std::size_t k = 0; k < 4; ++k) {
            square += double{quaternions[4 * i + k]} * double{quaternions[4 * i + k]};
        }
        // Negated so that NaN fails.
        if (!(std::abs(std::sqrt(square) - 1.0) <= 1e-3)) return false;
    }
    return true;
}

void check(const cdir_match_event& event) {
    require(event.kind >= CDIR_EVENT_KILL, "an event's kind must be one of CDIR_EVENT_, or greater");
    require(std::isfinite(event.value), "an event's value is not finite");
    check_frame_time(event.frame_time);
    require(event.reserved == 0, "event.reserved is not 0");
    const std::string detail = checked_string("an event's detail", event.detail, 0, sizeof event.detail - 1);
    require(!has_control_character(detail), "an event's detail must not contain control characters");
}

bool is_valid(const camera_director_ShownMatch& info, const std::string& match_id) {
    const std::uint32_t n = info.player_id._length;
    return info.match_id == match_id && n <= CDIR_MAX_PLAYERS && info.map_name != nullptr &&
           std::strlen(info.map_name) < sizeof cdir_match_info::map_name &&
           std::isfinite(info.metres_per_unit) && info.metres_per_unit >= 0.0F &&
           std::isfinite(info.rate_hz) && info.rate_hz > 0.0F && std::isfinite(info.spectator_delay_s) &&
           info.spectator_delay_s >= 0.0F && is_parallel(info.player_name, n) &&
           is_parallel(info.player_class, n) && is_parallel(info.player_team, n);
}

bool is_valid(const camera_director_CameraFrame& frame, const std::string& match_id) {
    const std::uint32_t n = frame.camera_id._length;
    const bool lengths = n <= CDIR_MAX_CAMERAS && frame.target._length == n &&
                         frame.position._length == 3 * n && frame.orientation._length == 4 * n &&
                         frame.vertical_fov._length == n && frame.clearance._length == n &&
                         frame.flags._length == n && frame.reasons._length <= CDIR_MAX_CAMERAS;
    return lengths && frame.match_id == match_id && is_time(frame.frame_time) &&
           is_in_reach(frame.position) && all_unit(frame.orientation._buffer, n) && finite(frame.clearance) &&
           std::all_of(frame.vertical_fov._buffer, frame.vertical_fov._buffer + n,
                       [](float fov) { return fov > 0.0F && fov < pi; });
}

bool is_valid(const camera_director_ObserverStatus& status) {
    return status.state <= CDIR_SHOT_WAITING_FOR_PLAYER;
}

}  // namespace camdir::sdk
