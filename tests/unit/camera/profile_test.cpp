#include "camera/profile.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "walk.hpp"

namespace camdir::camera {

static void PrintTo(const ProfileKey& key, std::ostream* out) {
    *out << key.name;
}

namespace {

const ProfileKey& key_named(const std::string& name) {
    const auto keys = profile_keys();
    return *std::find_if(keys.begin(), keys.end(), [&](const ProfileKey& key) { return key.name == name; });
}

Profile with(const std::string& name, float value, Solver solver) {
    Profile profile = solved_by(solver);
    profile.*key_named(name).member = value;
    return profile;
}

TEST(ProfileKeys, NameEveryMemberOnceWithItsDefaultInRange) {
    std::set<std::string> names;
    for (const ProfileKey& key : profile_keys()) {
        SCOPED_TRACE(key.name);
        EXPECT_TRUE(names.insert(key.name).second);
        EXPECT_THAT(std::string(key.unit),
                    testing::AnyOf("units", "units/s", "degrees", "degrees/s", "s", "1/s", ""));
        EXPECT_LT(key.minimum, key.maximum);
        EXPECT_GE(Profile{}.*key.member, key.minimum);
        EXPECT_LE(Profile{}.*key.member, key.maximum);
        EXPECT_STRNE(key.help, "");
    }
    EXPECT_EQ(names.size() * sizeof(float) + sizeof(Solver), sizeof(Profile));
}

TEST(ProfileKeys, ScaleToTheMapsUnits) {
    const MapProfile metres(Profile{}, 1.0F);
    EXPECT_FLOAT_EQ(metres.distance, 120.0F * 0.0254F);
    EXPECT_FLOAT_EQ(metres.speed_tolerance, 400.0F * 0.0254F);
    EXPECT_FLOAT_EQ(metres.angle_tolerance, std::numbers::pi_v<float> / 4.0F);
    EXPECT_FLOAT_EQ(metres.search_time_limit, Profile{}.search_time_limit);
    EXPECT_FLOAT_EQ(metres.weight_angle, Profile{}.weight_angle);
    EXPECT_FLOAT_EQ(MapProfile(Profile{}, 0.0254F).distance, 120.0F);
}

// Two loops, and a room that no way leads to.
test::Plan loops_and_cell() {
    return test::Plan({"##################",  //
                       "#s..............##",  //
                       "#...............##",  //
                       "#..#####..#####..#",  //
                       "#..#.x.#..#####..#",  //
                       "#..#####..#####..#",  //
                       "#................#",  //
                       "#...............t#",  //
                       "##################"});
}

// A match in thirteen seconds: running, a jump to where the camera does not see, running on, running so fast
// round corners that the camera has to hurry, and a jump to where it cannot go.
struct Shown {
    std::vector<Camera> cameras;
    std::vector<Pose> poses;
};

Shown show(const Profile& profile) {
    const test::Plan plan = loops_and_cell();
    CheckedShot shot(plan, profile);
    Shown shown;
    struct Leg {
        char place;
        int frames;
        float pace;
    };
    for (const Leg& leg :
         {Leg{'s', 150, 1.0F}, Leg{'t', 150, 1.0F}, Leg{'s', 360, 4.0F}, Leg{'x', 110, 1.0F}}) {
        Runner runner(plan, plan.eye(leg.place), 7);
        for (int i = 0; i < leg.frames; ++i) {
            shown.poses.push_back(runner.next(leg.pace / 60.0F));
            shown.cameras.push_back(shot.step(shown.poses.back()));
        }
    }
    return shown;
}

template <class Measure>
double mean(const Shown& shown, const Measure& measure) {
    double sum = 0.0;
    for (std::size_t i = 1; i < shown.cameras.size(); ++i)
        sum += measure(shown, i);
    return sum / static_cast<double>(shown.cameras.size() - 1);
}

class EveryKey : public testing::TestWithParam<ProfileKey> {};

INSTANTIATE_TEST_SUITE_P(Profile, EveryKey, testing::ValuesIn(profile_keys().begin(), profile_keys().end()),
                         [](const auto& key) { return std::string(key.param.name); });

bool differ(const Shown& a, const Shown& b) {
    const auto same = [](const Camera& one, const Camera& other) {
        return one.position == other.position && one.orientation.coeffs() == other.orientation.coeffs() &&
               one.vertical_fov == other.vertical_fov && one.objective.total == other.objective.total;
    };
    return !std::equal(a.cameras.begin(), a.cameras.end(), b.cameras.begin(), b.cameras.end(), same);
}

bool changes_the_camera(const ProfileKey& key, Solver solver) {
    const float usual = Profile{}.*key.member;
    const float less = std::max(0.3F * usual, key.minimum);
    const float more = std::min(usual == 0.0F ? 10.0F : 10.0F * usual, key.maximum);
    const Shown shown = show(solved_by(solver));
    return differ(shown, show(with(key.name, less, solver))) ||
           differ(shown, show(with(key.name, more, solver)));
}

TEST_P(EveryKey, ChangesTheCamera) {
    const ProfileKey& key = GetParam();
    const bool of_paper_alone = std::string(key.name) == "iterations";
    EXPECT_TRUE(changes_the_camera(key, of_paper_alone ? Solver::paper : Solver::planner));
}

// What a larger value makes larger.
struct Effect {
    const char* key;
    float small;
    float large;
    const char* what;
    double (*measure)(const Shown&, std::size_t);
};

double distance(const Shown& s, std::size_t i) {
    return (s.cameras[i].position - s.poses[i].eye).norm();
}
double height(const Shown& s, std::size_t i) {
    return s.cameras[i].position.z() - s.poses[i].eye.z();
}
double clearance(const Shown& s, std::size_t i) {
    return s.cameras[i].clearance;
}
double field_of_view(const Shown& s, std::size_t i) {
    return s.cameras[i].vertical_fov;
}
double step_length(const Shown& s, std::size_t i) {
    return (s.cameras[i].flags & cut) != 0 ? 0.0 : (s.cameras[i].position - s.cameras[i - 1].position).norm();
}
double turn(const Shown& s, std::size_t i) {
    return s.cameras[i].orientation.angularDistance(s.cameras[i - 1].orientation);
}
double off_centre(const Shown& s, std::size_t i) {
    return angle_between(s.cameras[i].orientation * Vec3f::UnitX(), s.poses[i].eye - s.cameras[i].position);
}
double eye_below_middle(const Shown& s, std::size_t i) {
    return look_along(s.cameras[i].orientation * Vec3f::UnitX(), 0.0F).pitch -
           look_along(s.poses[i].eye - s.cameras[i].position, 0.0F).pitch;
}
double behind(const Shown& s, std::size_t i) {
    return angle_between(s.poses[i].eye - s.cameras[i].position, s.poses[i].orientation * Vec3f::UnitX());
}
double off_their_view(const Shown& s, std::size_t i) {
    return angle_between(s.cameras[i].orientation * Vec3f::UnitX(), s.poses[i].orientation * Vec3f::UnitX());
}
double searched(const Shown& s, std::size_t i) {
    return (s.cameras[i].flags & searching) != 0 ? 1.0 : 0.0;
}
double distance_term(const Shown& s, std::size_t i) {
    return s.cameras[i].objective.distance;
}
double angle_term(const Shown& s, std::size_t i) {
    return s.cameras[i].objective.angle;
}
double inertia_term(const Shown& s, std::size_t i) {
    return s.cameras[i].objective.inertia_distance;
}
double safety_term(const Shown& s, std::size_t i) {
    return s.cameras[i].objective.safety;
}

constexpr Effect effects[] = {
    {"distance", 60.0F, 180.0F, "distance", distance},
    {"elevation", 0.0F, 40.0F, "height", height},
    {"distance_tolerance", 200.0F, 60.0F, "distance_term", distance_term},
    {"angle_tolerance", 150.0F, 30.0F, "angle_term", angle_term},
    {"weight_inertia_distance", 0.1F, 5.0F, "inertia_term", inertia_term},
    {"weight_safety", 0.5F, 5.0F, "safety_term", safety_term},
    {"safe_speed", 40000.0F, 400.0F, "safety_term", safety_term},
    {"safe_speed", 40000.0F, 400.0F, "clearance", clearance},
    {"heading_smoothing", 0.02F, 0.6F, "behind", behind},
    {"motion_smoothing", 0.3F, 0.05F, "step_length", step_length},
    {"look_smoothing", 0.0F, 0.5F, "off_centre", off_centre},
    {"turn_limit", 30.0F, 600.0F, "turn", turn},
    {"step_limit", 3.0F, 55.0F, "step_length", step_length},
    {"search_time_limit", 0.05F, 3.0F, "searched", searched},
    {"vertical_fov", 40.0F, 90.0F, "field_of_view", field_of_view},
    {"framing_offset", -5.0F, 5.0F, "eye_below_middle", eye_below_middle},
    {"lead_room", 0.8F, 0.0F, "off_their_view", off_their_view},
};

void PrintTo(const Effect& effect, std::ostream* out) {
    *out << effect.key;
}

std::string name_of_case(const testing::TestParamInfo<std::tuple<Solver, Effect>>& info) {
    const auto& [solver, effect] = info.param;
    return std::string(name_of(solver)) + "_" + effect.key + "_" + effect.what;
}

class EveryEffect : public testing::TestWithParam<std::tuple<Solver, Effect>> {};

// The planner does not weigh safety where it follows; the paper's solver leaves no lead room.
std::vector<std::tuple<Solver, Effect>> effects_by_solver() {
    std::vector<std::tuple<Solver, Effect>> cases;
    for (const Effect& effect : effects) {
        if (effect.measure != off_their_view) cases.emplace_back(Solver::paper, effect);
        if (effect.measure != clearance) cases.emplace_back(Solver::planner, effect);
    }
    return cases;
}

INSTANTIATE_TEST_SUITE_P(Profile, EveryEffect, testing::ValuesIn(effects_by_solver()), name_of_case);

TEST_P(EveryEffect, GoesTheRightWay) {
    const auto& [solver, effect] = GetParam();
    EXPECT_LT(mean(show(with(effect.key, effect.small, solver)), effect.measure),
              mean(show(with(effect.key, effect.large, solver)), effect.measure));
}

}  // namespace
}  // namespace camdir::camera
