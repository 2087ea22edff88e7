#include "camera/profile.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>

#include "base/geometry.hpp"

namespace camdir::camera {
namespace {

constexpr const char* units = "units";
constexpr const char* units_per_second = "units/s";
constexpr const char* degrees = "degrees";
constexpr const char* degrees_per_second = "degrees/s";
constexpr const char* seconds = "s";
constexpr const char* per_second = "1/s";
constexpr const char* number = "";

constexpr std::array keys = {
    ProfileKey{"distance", units, 20.0F, 2000.0F, "desired distance between the camera and the player's eye",
               &Profile::distance},
    ProfileKey{"elevation", degrees, -60.0F, 80.0F,
               "how far the desired spot lies above the player's line of view", &Profile::elevation},
    ProfileKey{"distance_tolerance", units, 1.0F, 2000.0F, "deviation from the desired distance that costs 1",
               &Profile::distance_tolerance},
    ProfileKey{"angle_tolerance", degrees, 1.0F, 180.0F,
               "deviation from the desired direction of view that costs 1", &Profile::angle_tolerance},
    ProfileKey{"speed_tolerance", units_per_second, 1.0F, 10000.0F,
               "change of the camera's velocity within one step that costs 1", &Profile::speed_tolerance},
    ProfileKey{
        "weight_visibility", number, 0.0F, 10.0F,
        "weight of seeing the player: power of the factor c_vis, weight of looking past other players, of "
        "keeping up with the player and of the roadmap in a search",
        &Profile::weight_visibility},
    ProfileKey{"weight_distance", number, 0.0F, 10.0F, "weight of the desired distance",
               &Profile::weight_distance},
    ProfileKey{"weight_angle", number, 0.0F, 10.0F, "weight of the desired direction of view",
               &Profile::weight_angle},
    ProfileKey{"weight_inertia_distance", number, 0.0F, 10.0F, "weight of keeping the camera's speed",
               &Profile::weight_inertia_distance},
    ProfileKey{"weight_inertia_angle", number, 0.0F, 10.0F,
               "weight of keeping the camera's direction of motion", &Profile::weight_inertia_angle},
    ProfileKey{"weight_safety", number, 0.0F, 10.0F, "weight of distance to the obstacles at speed",
               &Profile::weight_safety},
    ProfileKey{"visibility_threshold", units, 0.0F, 100.0F,
               "clearance that the line of sight must have for the player to count as seen",
               &Profile::visibility_threshold},
    ProfileKey{"minimum_clearance", units, 0.0F, 100.0F,
               "clearance that the camera keeps; above 4.5, no more than two thirds of what the player has",
               &Profile::minimum_clearance},
    ProfileKey{"safe_speed", units_per_second, 1.0F, 100000.0F,
               "speed at which a clearance of minimum_clearance costs 1", &Profile::safe_speed},
    ProfileKey{"swing", degrees, 0.0F, 180.0F,
               "how far round the player the camera looks for a free spot when the one behind is blocked",
               &Profile::swing},
    ProfileKey{"prediction", seconds, 0.0F, 1.0F,
               "how far ahead the player's motion is foreseen when a spot is chosen", &Profile::prediction},
    ProfileKey{
        "iterations", number, 1.0F, 8.0F,
        "moves that solver `paper` tries in one step before it restores the line of sight by other means",
        &Profile::iterations},
    ProfileKey{"heading_smoothing", seconds, 0.0F, 2.0F,
               "time constant of the low-passed view direction that the camera stays behind",
               &Profile::heading_smoothing},
    ProfileKey{"motion_smoothing", seconds, 0.001F, 2.0F, "time constant of the camera's motion",
               &Profile::motion_smoothing},
    ProfileKey{"look_smoothing", seconds, 0.0F, 2.0F, "time constant of the camera's rotation",
               &Profile::look_smoothing},
    ProfileKey{"turn_limit", degrees_per_second, 10.0F, 10000.0F, "fastest rotation of the camera",
               &Profile::turn_limit},
    ProfileKey{"step_limit", units, 1.0F, 1000.0F, "longest step of the camera that is no cut",
               &Profile::step_limit},
    ProfileKey{"search_growth", per_second, 0.0F, 100.0F,
               "growth rate of the roadmap's weight while the player stays lost", &Profile::search_growth},
    ProfileKey{"search_time_limit", seconds, 0.0F, 60.0F, "time until a search ends with a cut",
               &Profile::search_time_limit},
    ProfileKey{"vertical_fov", degrees, 10.0F, 150.0F, "vertical field of view", &Profile::vertical_fov},
    ProfileKey{"framing_offset", degrees, -30.0F, 30.0F,
               "how far below the middle of the image the player's eye is shown", &Profile::framing_offset},
    ProfileKey{"lead_room", number, 0.0F, 1.0F,
               "how far in front of the player a planned shot looks, as a share of the distance to them: "
               "room in the image for what they look at",
               &Profile::lead_room},
};
static_assert(keys.size() * sizeof(float) + sizeof(Solver) == sizeof(Profile), "every number has one key");

enum class Scale : std::uint8_t { none, length, angle };

constexpr Scale scale_of(std::string_view unit) {
    if (unit == units || unit == units_per_second) return Scale::length;
    if (unit == degrees || unit == degrees_per_second) return Scale::angle;
    return Scale::none;
}

// Of each key: every step of a shot scales its profile.
constexpr auto scales = [] {
    std::array<Scale, keys.size()> all{};
    std::transform(keys.begin(), keys.end(), all.begin(),
                   [](const ProfileKey& key) { return scale_of(key.unit); });
    return all;
}();

constexpr Profile broadcast() {
    Profile profile;
    profile.heading_smoothing = 0.6F;
    profile.motion_smoothing = 0.08F;
    profile.look_smoothing = 0.1F;
    profile.angle_tolerance = 60.0F;
    profile.swing = 85.0F;
    profile.weight_inertia_angle = 4.0F;
    profile.weight_inertia_distance = 3.0F;
    profile.lead_room = 0.1F;
    return profile;
}

constexpr Profile close() {
    Profile profile;
    profile.distance = 70.0F;
    profile.distance_tolerance = 30.0F;
    return profile;
}

constexpr Profile tactical() {
    Profile profile;
    profile.distance = 220.0F;
    profile.distance_tolerance = 90.0F;
    profile.elevation = 35.0F;
    profile.heading_smoothing = 0.8F;
    profile.motion_smoothing = 0.15F;
    profile.look_smoothing = 0.08F;
    profile.angle_tolerance = 90.0F;
    profile.swing = 120.0F;
    profile.weight_inertia_angle = 4.0F;
    profile.lead_room = 0.15F;
    return profile;
}

constexpr std::array shipped = {
    ShippedProfile{"default", "behind the player, for every game", Profile{}},
    ShippedProfile{"broadcast", "slow turns for long watching, made for a delay of 2 s or more", broadcast()},
    ShippedProfile{"close", "near the player", close()},
    ShippedProfile{"tactical", "calm and from above, to see who is around", tactical()},
};

}  // namespace

std::span<const ProfileKey> profile_keys() {
    return keys;
}

std::span<const ShippedProfile> shipped_profiles() {
    return shipped;
}

MapProfile::MapProfile(const Profile& profile, float metres_per_unit)
    : Profile(profile), unit(static_cast<float>(metres_of_nominal_unit) / metres_per_unit) {
    const std::array factors = {1.0F, unit, radians_of_a_degree<float>};  // in the order of Scale
    for (std::size_t i = 0; i < keys.size(); ++i)
        this->*keys[i].member *= factors[static_cast<std::size_t>(scales[i])];
}

}  // namespace camdir::camera
