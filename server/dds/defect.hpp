// Why a sample from outside was dropped.
#pragma once

#include <array>
#include <cstddef>

namespace camdir::dds {

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

}  // namespace camdir::dds
