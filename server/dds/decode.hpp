// From wire samples to the director's messages, with validation: arrays agree in length and are within the
// limits of the messages, numbers are finite, quaternions and normals have length 1, hulls are bounded.
#pragma once

#include <camera_director.h>

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

#include "dds/succession.hpp"
#include "director/messages.hpp"

namespace camdir::dds {

// Why a sample from outside was dropped.
enum class ValidationError : std::size_t {
    array_length,  // the sample's arrays disagree in length
    too_many,      // more than 256 players, group members, movers, cameras or their reasons; more of a shape
                   // than its limits
    not_finite,    // a number is infinite or not a number
    not_unit,      // the length of a quaternion or normal is off 1 by more than 1e-3
    out_of_range,  // a negative rate, delay or scale; a ball without radius, or one or a half space too far
                   // away; a term or rank beyond the greatest; a lease of 0 or beyond the greatest; a
                   // player's id that is reserved
    duplicate,     // a player or mover is named twice
    bad_hull,      // a hull of fewer than 4 half spaces, or empty, or unbounded
    bad_match_id,  // empty, or not usable as the name of a partition
    wrong_partition,    // the sample names another match than its partition does
    long_map_name,      // more than 255 bytes: no configured map has such a name
    not_owner,          // the match is another participant's, or the request another writer's
    participant_limit,  // the participant has as many matches or observers as it may have
    participant_rate,   // the participant begins matches faster than it may
    waiting_limit,      // as many matches wait as may wait, of the participant or in all
};

// Names in metrics and log, in the order of ValidationError.
inline constexpr std::array<const char*, 14> validation_error_names = {
    "array_length", "too_many",          "not_finite",       "not_unit",        "out_of_range",
    "duplicate",    "bad_hull",          "bad_match_id",     "wrong_partition", "long_map_name",
    "not_owner",    "participant_limit", "participant_rate", "waiting_limit"};

// Each function fills `message`, whose memory it reuses, or returns the first error found and leaves
// `message` unspecified. Reads nothing beyond the sample's arrays.
[[nodiscard]] std::optional<ValidationError> decode(const camera_director_MatchInfo& sample,
                                                    director::MatchInfo& message);
[[nodiscard]] std::optional<ValidationError> decode(const camera_director_PoseFrame& sample,
                                                    director::PoseFrame& message);
[[nodiscard]] std::optional<ValidationError> decode(const camera_director_MatchEvent& sample,
                                                    director::MatchEvent& message);
// The hulls have no bounds yet.
[[nodiscard]] std::optional<ValidationError> decode(const camera_director_MoverInfo& sample,
                                                    director::MoverInfo& message);
// Then, for the next `most` of those without: up to 1 ms a hull.
[[nodiscard]] std::optional<ValidationError> bound_hulls(director::MoverInfo& message, std::size_t most);
// All hulls have theirs.
[[nodiscard]] bool has_bounds(const director::MoverInfo& message);
[[nodiscard]] std::optional<ValidationError> decode(const camera_director_MoverFrame& sample,
                                                    director::MoverFrame& message);
[[nodiscard]] std::optional<ValidationError> decode(const camera_director_ObserverRequest& sample,
                                                    director::ObserverRequest& message);

[[nodiscard]] std::optional<ValidationError> decode(const camera_director_CameraFrame& sample,
                                                    director::CameraFrame& message);

[[nodiscard]] std::optional<ValidationError> decode(const camera_director_DirectorSign& sample, Sign& sign);

// True when the id can name a partition: not empty, without control characters, '/', '*' and '?'.
[[nodiscard]] bool valid_match_id(std::string_view match_id);

}  // namespace camdir::dds
