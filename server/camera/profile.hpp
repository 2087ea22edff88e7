// A profile: how a shot should look. Every number is in the one table below, from which the configuration's
// validation, its reference and the observers' overrides are made.
#pragma once

#include <span>

namespace camdir::camera {

// Lengths are units of 0.0254 m and scale with the map's metres_per_unit; angles are degrees, as in JSON.
struct Profile {
    float distance = 120.0F;  // d_opt
    // ... weights and parameters of the six terms, the search and the cut
};

struct ProfileKey {
    const char* name;
    const char* unit;
    float minimum;
    float maximum;
    const char* help;
    float Profile::*member;  // the default is the member's initialiser
};

// Every member of Profile once, in the order of the documentation.
[[nodiscard]] std::span<const ProfileKey> profile_keys();

}  // namespace camdir::camera
