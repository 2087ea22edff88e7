#include "dds/decode.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "support/raw_peer.hpp"

namespace camdir::dds {
namespace {

using test::RawPoseFrame;

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float nan = std::numeric_limits<float>::quiet_NaN();

RawPoseFrame random_frame(std::uint32_t count, std::uint32_t seed) {
    std::mt19937 random(seed);
    std::normal_distribution<float> normal;
    RawPoseFrame frame("m", random(), static_cast<std::uint32_t>(random()), count);
    for (float& value : frame.eye)
        value = 1000.0F * normal(random);
    for (float& value : frame.velocity)
        value = 300.0F * normal(random);
    for (std::uint32_t& flags : frame.flags)
        flags = random() & 7U;
    for (std::uint32_t i = 0; i < count; ++i)
        frame.discontinuities.push_back(static_cast<std::uint32_t>(random()));
    for (std::uint32_t i = 0; i < count; ++i) {
        const Eigen::Vector4f quaternion(normal(random), normal(random), normal(random), normal(random));
        Eigen::Vector4f::Map(&frame.orientation[4 * i]) = quaternion.normalized();
    }
    return frame;
}

RC_GTEST_PROP(DecodePoseFrame, KeepsEveryNumberOfAValidFrame, (std::uint32_t seed)) {
    const std::uint32_t count = *rc::gen::inRange<std::uint32_t>(0, 257);
    RawPoseFrame frame = random_frame(count, seed);
    if (seed % 3 == 0) frame.velocity.clear();
    if (seed % 5 == 0) frame.discontinuities.clear();
    director::PoseFrame message;
    message.poses.resize(seed % 300);  // left over from another frame
    RC_ASSERT(!decode(frame.sample(), message));

    RC_ASSERT(message.epoch == frame.sample().epoch);
    RC_ASSERT(message.frame_number == frame.sample().frame_number);
    RC_ASSERT(message.frame_time == frame.sample().frame_time);
    RC_ASSERT(message.poses.size() == count);
    for (std::uint32_t i = 0; i < count; ++i) {
        const director::PlayerPose& pose = message.poses[i];
        RC_ASSERT(pose.player_id == frame.player_id[i]);
        RC_ASSERT(pose.flags == frame.flags[i]);
        RC_ASSERT(pose.discontinuities.has_value() == !frame.discontinuities.empty());
        RC_ASSERT(frame.discontinuities.empty() || pose.discontinuities == frame.discontinuities[i]);
        RC_ASSERT(pose.eye == Vec3f(&frame.eye[3 * i]));
        RC_ASSERT(pose.velocity ==
                  (frame.velocity.empty() ? Vec3f(Vec3f::Zero()) : Vec3f(&frame.velocity[3 * i])));
        RC_ASSERT(pose.orientation.x() == frame.orientation[4 * i]);
        RC_ASSERT(pose.orientation.w() == frame.orientation[4 * i + 3]);
    }
}

RC_GTEST_PROP(DecodePoseFrame, RefusesOneBadNumberAnywhere, (std::uint32_t seed)) {
    const std::uint32_t count = *rc::gen::inRange<std::uint32_t>(1, 257);
    RawPoseFrame frame = random_frame(count, seed);
    std::mt19937 random(seed);
    std::vector<float>* const arrays[] = {&frame.eye, &frame.orientation, &frame.velocity};
    std::vector<float>& values = *arrays[random() % 3];
    const float bad[] = {infinity, -infinity, nan};
    values[random() % values.size()] = bad[random() % 3];
    director::PoseFrame message;
    RC_ASSERT(decode(frame.sample(), message) == ValidationError::not_finite);
}

RC_GTEST_PROP(DecodePoseFrame, RefusesArraysThatDisagree, (std::uint32_t seed)) {
    const std::uint32_t count = *rc::gen::inRange<std::uint32_t>(1, 257);
    RawPoseFrame frame = random_frame(count, seed);
    std::mt19937 random(seed);
    const auto other_length = [&](auto& values) {
        const std::size_t was = values.size();
        while (values.size() == was)
            values.resize(random() % 1200);
        const bool may_be_empty = &values == static_cast<void*>(&frame.velocity) ||
                                  &values == static_cast<void*>(&frame.discontinuities);
        if (may_be_empty && values.empty()) values.resize(count + 1);
    };
    switch (random() % 5) {
        case 0:
            other_length(frame.eye);
            break;
        case 1:
            other_length(frame.orientation);
            break;
        case 2:
            other_length(frame.velocity);
            break;
        case 3:
            other_length(frame.discontinuities);
            break;
        default:
            other_length(frame.flags);
            break;
    }
    director::PoseFrame message;
    RC_ASSERT(decode(frame.sample(), message) == ValidationError::array_length);
}

TEST(DecodePoseFrame, RefusesMoreThan256Players) {
    RawPoseFrame frame("m", 1, 1, 257);
    director::PoseFrame message;
    EXPECT_EQ(decode(frame.sample(), message), ValidationError::too_many);
}

TEST(DecodePoseFrame, AcceptsQuaternionsUpToAThousandthOffUnitLength) {
    const auto verdict = [](float length) {
        RawPoseFrame frame("m", 1, 1, 2);
        frame.orientation[7] = length;
        director::PoseFrame message;
        return decode(frame.sample(), message);
    };
    EXPECT_EQ(verdict(1.0009F), std::nullopt);
    EXPECT_EQ(verdict(0.9991F), std::nullopt);
    EXPECT_EQ(verdict(1.0011F), ValidationError::not_unit);
    EXPECT_EQ(verdict(0.9989F), ValidationError::not_unit);
    EXPECT_EQ(verdict(0.0F), ValidationError::not_unit);
    EXPECT_EQ(verdict(3e38F), ValidationError::not_unit) << "its length overflows";
}

TEST(DecodeMatchInfo, TakesPlayersWithAndWithoutNamesAndClasses) {
    camera_director_MatchInfo sample = test::raw_match_info("cup-7", 3);
    std::uint32_t ids[] = {5, 9};
    char names[2][64] = {"anna", "bob"};
    std::uint8_t teams[] = {1, 2};
    sample.player_id = {2, 2, ids, false};
    sample.player_name = {2, 2, names, false};
    sample.player_team = {2, 2, teams, false};
    director::MatchInfo message;
    ASSERT_EQ(decode(sample, message), std::nullopt);
    EXPECT_EQ(message.match_id, "cup-7");
    EXPECT_EQ(message.epoch, 3U);
    EXPECT_EQ(message.map_name, "test_map");
    ASSERT_EQ(message.players.size(), 2U);
    EXPECT_EQ(message.players[1].id, 9U);
    EXPECT_EQ(message.players[1].name, "bob");
    EXPECT_EQ(message.players[1].player_class, "");
    EXPECT_EQ(message.players[1].team, 2);

    sample.player_name._length = 1;
    EXPECT_EQ(decode(sample, message), ValidationError::array_length);
}

TEST(DecodeMatchInfo, RefusesInvalidNumbers) {
    director::MatchInfo message;
    camera_director_MatchInfo sample = test::raw_match_info("m", 1);
    sample.rate_hz = nan;
    EXPECT_EQ(decode(sample, message), ValidationError::not_finite);
    sample = test::raw_match_info("m", 1);
    sample.spectator_delay_s = -1.0F;
    EXPECT_EQ(decode(sample, message), ValidationError::out_of_range);
    sample = test::raw_match_info("m", 1);
    sample.player_id._length = 257;  // refused before an array is read
    EXPECT_EQ(decode(sample, message), ValidationError::too_many);
}

TEST(DecodeMatchInfo, RefusesALongMapName) {
    director::MatchInfo message;
    camera_director_MatchInfo sample = test::raw_match_info("m", 1);
    std::string name(255, 'x');
    sample.map_name = name.data();
    EXPECT_EQ(decode(sample, message), std::nullopt);
    EXPECT_EQ(message.map_name, name);
    name += 'x';
    sample.map_name = name.data();
    EXPECT_EQ(decode(sample, message), ValidationError::long_map_name);
}

TEST(DecodeMatchInfo, RefusesIdsThatCannotNameAPartition) {
    for (const char* id : {"", "*", "cup?", "a/b", "tab\t"}) {
        director::MatchInfo message;
        EXPECT_EQ(decode(test::raw_match_info(id, 1), message), ValidationError::bad_match_id) << id;
    }
    EXPECT_TRUE(valid_match_id("Große Halle [2] 'x' & <y>"));
}

TEST(DecodeMatchEvent, KeepsTheFieldsAndRefusesAValueThatIsNotFinite) {
    camera_director_MatchEvent sample{};
    sample.kind = 1;
    sample.actor = 4;
    sample.subject = director::no_player;
    sample.value = 2.5F;
    std::snprintf(sample.detail, sizeof sample.detail, "MOD_ROCKET");
    director::MatchEvent message;
    ASSERT_EQ(decode(sample, message), std::nullopt);
    EXPECT_EQ(message.actor, 4U);
    EXPECT_EQ(message.value, 2.5F);
    EXPECT_EQ(message.detail, "MOD_ROCKET");
    sample.value = infinity;
    EXPECT_EQ(decode(sample, message), ValidationError::not_finite);
}

TEST(DecodeObserverRequest, KeepsTheGroupAndTheStrings) {
    camera_director_ObserverRequest sample = test::raw_request("m", "o", 7);
    std::vector<std::uint32_t> group(257, 1);
    sample.group = {257, 256, group.data(), false};
    std::snprintf(sample.profile, sizeof sample.profile, "close");
    std::snprintf(sample.overrides, sizeof sample.overrides, R"({"distance": 60})");
    director::ObserverRequest message;
    message.group = {1, 2, 3};
    ASSERT_EQ(decode(sample, message), std::nullopt);
    EXPECT_EQ(message.match_id, "m");
    EXPECT_EQ(message.observer_id, "o");
    EXPECT_EQ(message.target, 7U);
    EXPECT_EQ(message.group.size(), 256U);
    EXPECT_EQ(message.profile, "close");
    EXPECT_EQ(message.overrides, R"({"distance": 60})");
    sample.group._length = 257;
    EXPECT_EQ(decode(sample, message), ValidationError::too_many);
}

}  // namespace
}  // namespace camdir::dds
