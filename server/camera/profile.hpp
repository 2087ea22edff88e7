// A profile: how a shot should look. Every number is in the one table below, from which the configuration's
// validation, its reference and the observers' overrides are made.
#pragma once

#include <cstdint>
#include <span>

namespace camdir::camera {

// How a shot is solved: by the heuristic of the paper's section 5.3, or by planning over the player's future.
enum class Solver : std::uint32_t { paper, planner };

// Lengths are units of 0.0254 m and scale with the map's metres_per_unit; angles are degrees, as in JSON.
// Weights multiply a term of the objective (section 3) and the individual move made for it (section 5.3).
struct Profile {
    float distance = 120.0F;           // d_opt
    float elevation = 0.0F;            // of the spot behind, above the player's line of view
    float distance_tolerance = 50.0F;  // a deviation by this much costs 1
    float angle_tolerance = 45.0F;     // likewise
    float speed_tolerance = 400.0F;    // likewise, for changes of the camera's velocity

    float weight_visibility = 1.0F;
    float weight_distance = 1.0F;
    float weight_angle = 1.0F;
    float weight_inertia_distance = 1.0F;
    float weight_inertia_angle = 1.0F;
    float weight_safety = 1.0F;

    float visibility_threshold = 1.0F;
    float minimum_clearance = 4.5F;
    float safe_speed = 8000.0F;  // w(v) = v / safe_speed
    float swing = 75.0F;
    float prediction = 0.15F;
    float iterations = 2.0F;

    float heading_smoothing = 0.06F;
    float motion_smoothing = 0.07F;
    float look_smoothing = 0.04F;
    float turn_limit = 660.0F;
    float step_limit = 55.0F;

    float search_growth = 30.0F;
    float search_time_limit = 1.5F;

    float vertical_fov = 58.7F;
    float framing_offset = 0.0F;
    float lead_room = 0.4F;

    Solver solver = Solver::planner;
};

struct ProfileKey {
    const char* name;
    const char* unit;  // "units", "units/s", "degrees", "degrees/s", "s", "1/s", or "" for a plain number
    float minimum;
    float maximum;
    const char* help;
    float Profile::*member;  // the default is the member's initialiser
};

// Every number of Profile once, in the order of the documentation.
[[nodiscard]] std::span<const ProfileKey> profile_keys();

struct ShippedProfile {
    const char* name;
    const char* use;  // what it is for, for the documentation
    Profile profile;
};

// The profiles that every director has, `default` first.
[[nodiscard]] std::span<const ShippedProfile> shipped_profiles();

// The same profile in the units of a map: lengths in map units, angles in radians.
struct MapProfile : Profile {
    MapProfile(const Profile& profile, float metres_per_unit);

    float unit;  // 0.0254 m in map units
};

}  // namespace camdir::camera
