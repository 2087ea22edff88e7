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
        const Eigen::Vector4f sent = Eigen::Vector4f::Map(&frame.orientation[4 * i]);
        RC_ASSERT((pose.orientation.coeffs() - sent).norm() < 1e-6F);
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
        const auto error = decode(frame.sample(), message);
        EXPECT_TRUE(error || std::abs(message.poses[1].orientation.norm() - 1.0F) < 1e-6F);
        return error;
    };
    EXPECT_EQ(verdict(1.0009F), std::nullopt);
    EXPECT_EQ(verdict(0.9991F), std::nullopt);
    EXPECT_EQ(verdict(1.0011F), ValidationError::not_unit);
    EXPECT_EQ(verdict(0.9989F), ValidationError::not_unit);
    EXPECT_EQ(verdict(0.0F), ValidationError::not_unit);
    EXPECT_EQ(verdict(3e38F), ValidationError::not_unit) << "its length overflows";
}

TEST(DecodePlayers, TheirIdsAreDistinctAndNotReserved) {
    const auto verdict = [](std::uint32_t first, std::uint32_t second) {
        RawPoseFrame frame("m", 1, 1, 2);
        frame.player_id = {first, second};
        director::PoseFrame poses;
        const auto error = decode(frame.sample(), poses);
        camera_director_MatchInfo info = test::raw_match_info("m", 1);
        info.player_id = {2, 2, frame.player_id.data(), false};
        director::MatchInfo described;
        EXPECT_EQ(decode(info, described), error);
        return error;
    };
    EXPECT_EQ(verdict(0xfffffffdU, 0), std::nullopt);
    EXPECT_EQ(verdict(7, 7), ValidationError::duplicate);
    EXPECT_EQ(verdict(7, director::no_player), ValidationError::out_of_range);
    EXPECT_EQ(verdict(director::whole_group, 7), ValidationError::out_of_range);
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
    sample.team = 3;
    director::ObserverRequest message;
    message.group = {1, 2, 3};
    ASSERT_EQ(decode(sample, message), std::nullopt);
    EXPECT_EQ(message.match_id, "m");
    EXPECT_EQ(message.observer_id, "o");
    EXPECT_EQ(message.target, 7U);
    EXPECT_EQ(message.group.size(), 256U);
    EXPECT_EQ(message.profile, "close");
    EXPECT_EQ(message.overrides, R"({"distance": 60})");
    EXPECT_EQ(message.team, 3U);
    sample.group._length = 257;
    EXPECT_EQ(decode(sample, message), ValidationError::too_many);
}

test::RawMoverInfo door_and_cart() {
    test::RawMoverInfo info("m", 7);
    info.add_mover(40, "*3");
    info.add_mover(41);
    info.add_box({-4.0F, -32.0F, 0.0F}, {4.0F, 32.0F, 96.0F});
    info.add_box({-1.0F, -1.0F, -1.0F}, {1.0F, 1.0F, 1.0F});
    info.add_ball({0.0F, 0.0F, 100.0F}, 12.5F);
    return info;
}

std::optional<ValidationError> decode_whole(const camera_director_MoverInfo& sample,
                                            director::MoverInfo& message) {
    const auto error = decode(sample, message);
    return error ? error : bound_hulls(message, director::max_half_spaces);
}

TEST(DecodeMoverInfo, HullsGetTheirBoundsOneAfterTheOther) {
    test::RawMoverInfo info = door_and_cart();
    director::MoverInfo message;
    ASSERT_FALSE(decode(info.sample(), message));
    for (int hull = 0; hull < 2; ++hull) {
        EXPECT_FALSE(has_bounds(message)) << hull << " of 2";
        EXPECT_FALSE(bound_hulls(message, 1));
    }
    EXPECT_TRUE(has_bounds(message));

    info.planes[0] = -1.0F;  // of the first
    ASSERT_FALSE(decode(info.sample(), message));
    EXPECT_EQ(bound_hulls(message, 1), ValidationError::bad_hull);
}

TEST(DecodeMoverInfo, SharesTheShapesOutToTheirMovers) {
    test::RawMoverInfo info = door_and_cart();
    info.add_mover(7);
    info.add_ball({1.0F, 2.0F, 3.0F}, 4.0F);
    director::MoverInfo message;
    message.movers.resize(9);  // left over from another sample
    ASSERT_FALSE(decode_whole(info.sample(), message));
    EXPECT_EQ(message.epoch, 7U);
    ASSERT_EQ(message.movers.size(), 3U);
    EXPECT_EQ(message.movers[0].id, 40U);
    EXPECT_EQ(message.movers[0].shape.name, "*3");
    EXPECT_TRUE(message.movers[0].shape.hulls.empty());
    const freespace::MoverShape& cart = message.movers[1].shape;
    EXPECT_EQ(cart.name, "");
    ASSERT_EQ(cart.hulls.size(), 2U);
    ASSERT_EQ(cart.hulls[0].half_spaces.size(), 6U);
    EXPECT_TRUE(cart.hulls[0].bounds.min().isApprox(Vec3f(-4.0F, -32.0F, 0.0F), 1e-3F));
    EXPECT_TRUE(cart.hulls[0].bounds.max().isApprox(Vec3f(4.0F, 32.0F, 96.0F), 1e-3F));
    ASSERT_EQ(cart.balls.size(), 1U);
    EXPECT_EQ(cart.balls[0].radius, 12.5F);
    ASSERT_EQ(message.movers[2].shape.balls.size(), 1U);
    EXPECT_EQ(message.movers[2].shape.balls[0].centre, Vec3f(1.0F, 2.0F, 3.0F));
}

TEST(DecodeMoverInfo, ListsThatAllLackMayBeLeftOut) {
    test::RawMoverInfo info("m", 1);
    info.add_mover(1);
    info.add_mover(2);
    info.model.clear();
    info.hulls.clear();
    info.balls.clear();
    director::MoverInfo message;
    EXPECT_FALSE(decode_whole(info.sample(), message));
    EXPECT_EQ(message.movers.size(), 2U);
}

TEST(DecodeMoverInfo, RefusesWhatIsMalformed) {
    const auto verdict = [](const auto& spoil) {
        test::RawMoverInfo info = door_and_cart();
        spoil(info);
        director::MoverInfo message;
        return decode_whole(info.sample(), message);
    };
    using Info = test::RawMoverInfo;
    EXPECT_EQ(verdict([](Info& info) { info.model.pop_back(); }), ValidationError::array_length);
    EXPECT_EQ(verdict([](Info& info) { info.hulls[0] = 1; }), ValidationError::array_length);
    EXPECT_EQ(verdict([](Info& info) { info.hulls.pop_back(); }), ValidationError::array_length);
    EXPECT_EQ(verdict([](Info& info) { info.half_spaces[1] = 7; }), ValidationError::array_length);
    EXPECT_EQ(verdict([](Info& info) { info.planes.pop_back(); }), ValidationError::array_length);
    EXPECT_EQ(verdict([](Info& info) { info.balls[0] = 0xffffffffU; }), ValidationError::too_many);
    EXPECT_EQ(verdict([](Info& info) { info.spheres.clear(); }), ValidationError::array_length);
    EXPECT_EQ(verdict([](Info& info) { info.half_spaces = {3, 9}; }), ValidationError::bad_hull);
    EXPECT_EQ(verdict([](Info& info) { info.half_spaces = {0, 12}; }), ValidationError::bad_hull);
    EXPECT_EQ(verdict([](Info& info) { info.planes[3] = nan; }), ValidationError::not_finite);
    EXPECT_EQ(verdict([](Info& info) { info.spheres[1] = infinity; }), ValidationError::not_finite);
    EXPECT_EQ(verdict([](Info& info) { info.planes[0] = 1.01F; }), ValidationError::not_unit);
    EXPECT_EQ(verdict([](Info& info) { info.spheres[3] = 0.0F; }), ValidationError::out_of_range);
    EXPECT_EQ(verdict([](Info& info) { info.spheres[0] = 1e9F; }), ValidationError::out_of_range);
    EXPECT_EQ(verdict([](Info& info) { info.planes[3] = 1e9F; }), ValidationError::out_of_range);
    EXPECT_EQ(verdict([](Info& info) { info.mover_id[1] = info.mover_id[0]; }), ValidationError::duplicate);
    EXPECT_EQ(verdict([](Info& info) { info.planes[3] = -5.0F; }), ValidationError::bad_hull) << "empty";
    EXPECT_EQ(verdict([](Info& info) { info.planes[4] = 1.0F; }), ValidationError::bad_hull) << "unbounded";
}

TEST(DecodeMoverInfo, RefusesMoreThanItsLimits) {
    const auto verdict = [](const auto& fill) {
        test::RawMoverInfo info("m", 1);
        fill(info);
        director::MoverInfo message;
        return decode_whole(info.sample(), message);
    };
    const auto movers = [](std::uint32_t count) {
        return [=](test::RawMoverInfo& info) {
            for (std::uint32_t id = 0; id < count; ++id)
                info.add_mover(id, "*1");
        };
    };
    EXPECT_EQ(verdict(movers(256)), std::nullopt);
    EXPECT_EQ(verdict(movers(257)), ValidationError::too_many);
    const auto balls = [](std::uint32_t of_each, std::uint32_t count) {
        return [=](test::RawMoverInfo& info) {
            for (std::uint32_t id = 0; id < count; ++id) {
                info.add_mover(id);
                for (std::uint32_t i = 0; i < of_each; ++i)
                    info.add_ball({0.0F, 0.0F, 0.0F}, 1.0F);
            }
        };
    };
    EXPECT_EQ(verdict(balls(256, 8)), std::nullopt);
    EXPECT_EQ(verdict(balls(257, 1)), ValidationError::too_many);
    EXPECT_EQ(verdict(balls(228, 9)), ValidationError::too_many);
    const auto boxes = [](std::uint32_t count) {
        return [=](test::RawMoverInfo& info) {
            for (std::uint32_t i = 0; i < count; ++i) {
                if (i % 256 == 0) info.add_mover(i);
                info.add_box({0.0F, 0.0F, 0.0F}, {1.0F, 1.0F, 1.0F});
            }
        };
    };
    EXPECT_EQ(verdict(boxes(341)), std::nullopt);
    EXPECT_EQ(verdict(boxes(342)), ValidationError::too_many);
    EXPECT_EQ(verdict([](test::RawMoverInfo& info) {
                  info.add_mover(1);
                  info.hulls[0] = 1;
                  info.half_spaces = {65};
                  for (int i = 0; i < 65; ++i)
                      info.planes.insert(info.planes.end(), {1.0F, 0.0F, 0.0F, 1.0F});
              }),
              ValidationError::too_many);
}

TEST(DecodeMoverFrame, KeepsTheNumbersOfAValidFrame) {
    test::RawMoverFrame frame("m", 7, 1234);
    frame.add(40, {1.0F, 2.0F, 3.0F});
    frame.add(41, {4.0F, 5.0F, 6.0F});
    frame.orientation = {0.0F, 0.0F, 0.6F, 0.8F, 0.0F, 0.0F, 0.0F, 1.0F};
    director::MoverFrame message;
    ASSERT_FALSE(decode(frame.sample(), message));
    EXPECT_EQ(message.epoch, 7U);
    EXPECT_EQ(message.frame_time, 1234);
    ASSERT_EQ(message.poses.size(), 2U);
    EXPECT_EQ(message.poses[1].mover_id, 41U);
    EXPECT_EQ(message.poses[1].position, Vec3f(4.0F, 5.0F, 6.0F));
    EXPECT_EQ(message.poses[0].orientation.z(), 0.6F);
}

TEST(DecodeMoverFrame, RefusesWhatIsMalformed) {
    const auto verdict = [](const auto& spoil) {
        test::RawMoverFrame frame("m", 7, 1234);
        frame.add(40, {1.0F, 2.0F, 3.0F});
        spoil(frame);
        director::MoverFrame message;
        return decode(frame.sample(), message);
    };
    using Frame = test::RawMoverFrame;
    EXPECT_EQ(verdict([](Frame&) {}), std::nullopt);
    EXPECT_EQ(verdict([](Frame& frame) { frame.position.pop_back(); }), ValidationError::array_length);
    EXPECT_EQ(verdict([](Frame& frame) { frame.orientation.clear(); }), ValidationError::array_length);
    EXPECT_EQ(verdict([](Frame& frame) { frame.position[2] = nan; }), ValidationError::not_finite);
    EXPECT_EQ(verdict([](Frame& frame) { frame.orientation[3] = 0.5F; }), ValidationError::not_unit);
    EXPECT_EQ(verdict([](Frame& frame) {
                  for (std::uint32_t id = 0; id < 256; ++id)
                      frame.add(id, {0.0F, 0.0F, 0.0F});
              }),
              ValidationError::too_many);
}

}  // namespace
}  // namespace camdir::dds
