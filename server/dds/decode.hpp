// Wire samples become the director's messages, checked: arrays agree in length and hold at most 256
// elements, numbers are finite, quaternions have length 1.
//
// Each function fills `message`, whose memory is reused, and returns nothing; or returns the first defect
// that it found and leaves `message` in an unspecified state. Reads no further than the sample's own arrays.
#pragma once

#include <camera_director.h>

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

#include "director/messages.hpp"

namespace camdir::dds {

// Why a sample from outside was dropped.
enum class Defect : std::size_t {
    array_length,     // the sample's arrays disagree in length
    too_many,         // more than 256 players, cameras or group members
    not_finite,       // a number is infinite or not a number
    not_unit,         // a quaternion's length is off 1 by more than 1e-3
    out_of_range,     // a negative rate, delay or scale
    bad_match_id,     // empty, or not usable as the name of a partition
    wrong_partition,  // the sample speaks for another match than the one of its partition
};

// As they appear in the metrics and the log; the order is that of Defect.
inline constexpr std::array<const char*, 7> defect_names = {
    "array_length", "too_many", "not_finite", "not_unit", "out_of_range", "bad_match_id", "wrong_partition"};

[[nodiscard]] std::optional<Defect> decode(const camera_director_MatchInfo& sample,
                                           director::MatchInfo& message);
[[nodiscard]] std::optional<Defect> decode(const camera_director_PoseFrame& sample,
                                           director::PoseFrame& message);
[[nodiscard]] std::optional<Defect> decode(const camera_director_MatchEvent& sample,
                                           director::MatchEvent& message);
[[nodiscard]] std::optional<Defect> decode(const camera_director_ObserverRequest& sample,
                                           director::ObserverRequest& message);

// Can name a partition: not empty, no control characters, none of / * ?.
[[nodiscard]] bool valid_match_id(std::string_view match_id);

}  // namespace camdir::dds
