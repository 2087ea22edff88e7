// Wire samples become the director's messages, checked: arrays agree in length and hold at most 256
// elements, numbers are finite, quaternions have length 1.
//
// Each function fills `message`, whose memory is reused, and returns nothing; or returns the first defect
// that it found and leaves `message` in an unspecified state. Reads no further than the sample's own arrays.
#pragma once

#include <camera_director.h>

#include <optional>
#include <string_view>

#include "dds/defect.hpp"
#include "director/messages.hpp"

namespace camdir::dds {

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
