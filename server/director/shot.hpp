// A shot: what equal requests share.
#pragma once

#include <compare>
#include <cstdint>
#include <string>
#include <vector>

#include "camera/tracker.hpp"
#include "director/attention.hpp"

namespace camdir::director {

// Requests with equal keys share one camera.
struct ShotKey {
    std::uint32_t target = no_player;  // no_player: automatic
    std::vector<std::uint32_t> group;  // ascending, distinct
    std::string profile;
    std::string overrides;  // JSON as nlohmann writes it: keys sorted, no white space

    auto operator<=>(const ShotKey&) const = default;
};

// An id that is the same in every director that is asked for this shot, so that a standby's cameras go by
// the names that observers know. Never 0.
[[nodiscard]] std::uint32_t camera_id_of(const ShotKey& key);

struct Shot {
    ShotKey key;
    std::uint32_t camera_id = 0;
    camera::Profile profile;
    camera::ShotState state;
    AutomaticTarget automatic;
    std::uint32_t target = no_player;  // who is followed now
    std::uint64_t observers = 0;
    std::uint32_t flags = 0;  // of the last camera
};

}  // namespace camdir::director
