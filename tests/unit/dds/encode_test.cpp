#include "dds/encode.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <limits>
#include <random>

#include "dds/decode.hpp"
#include "support/descriptions.hpp"

namespace camdir::dds {
namespace {

director::CameraFrame random_camera_frame(std::size_t count, std::uint32_t seed) {
    std::mt19937 random(seed);
    std::normal_distribution<float> normal;
    director::CameraFrame frame;
    frame.epoch = random();
    frame.frame_number = static_cast<std::uint32_t>(random());
    frame.pose_number = static_cast<std::uint32_t>(random());
    frame.frame_time = random();
    frame.source_time = -static_cast<std::int64_t>(random());
    for (std::size_t i = 0; i < count; ++i) {
        director::ShotCamera camera;
        camera.camera_id = static_cast<std::uint32_t>(random());
        camera.target = static_cast<std::uint32_t>(random());
        camera.position = {normal(random), normal(random), normal(random)};
        camera.orientation = Quatf(normal(random), normal(random), normal(random), normal(random));
        camera.vertical_fov = normal(random);
        camera.clearance = normal(random);
        camera.flags = static_cast<std::uint32_t>(random());
        frame.cameras.push_back(camera);
    }
    return frame;
}

RC_GTEST_PROP(EncodeCameraFrame, EveryNumberIsInItsField, (std::uint32_t seed)) {
    CameraFrameEncoder encoder("cup-7", 42);
    // The second frame must not contain anything of the first.
    for (int round = 0; round < 2; ++round) {
        const auto count = *rc::gen::inRange<std::size_t>(0, 257);
        const director::CameraFrame frame =
            random_camera_frame(count, seed + static_cast<std::uint32_t>(round));
        const camera_director_CameraFrame& sample = encoder.encode(frame, 99);
        RC_ASSERT(std::string(sample.match_id) == "cup-7");
        RC_ASSERT(sample.director_id == 42U);
        RC_ASSERT(sample.write_time == 99);
        RC_ASSERT(sample.epoch == frame.epoch);
        RC_ASSERT(sample.frame_number == frame.frame_number);
        RC_ASSERT(sample.pose_number == frame.pose_number);
        RC_ASSERT(sample.frame_time == frame.frame_time);
        RC_ASSERT(sample.source_time == frame.source_time);
        RC_ASSERT(sample.camera_id._length == count && sample.target._length == count);
        RC_ASSERT(sample.position._length == 3 * count && sample.orientation._length == 4 * count);
        RC_ASSERT(sample.vertical_fov._length == count && sample.clearance._length == count);
        RC_ASSERT(sample.flags._length == count);
        for (std::size_t i = 0; i < count; ++i) {
            const director::ShotCamera& camera = frame.cameras[i];
            RC_ASSERT(sample.camera_id._buffer[i] == camera.camera_id);
            RC_ASSERT(sample.target._buffer[i] == camera.target);
            RC_ASSERT(sample.position._buffer[3 * i + 1] == camera.position.y());
            RC_ASSERT(sample.orientation._buffer[4 * i] == camera.orientation.x());
            RC_ASSERT(sample.orientation._buffer[4 * i + 3] == camera.orientation.w());
            RC_ASSERT(sample.vertical_fov._buffer[i] == camera.vertical_fov);
            RC_ASSERT(sample.clearance._buffer[i] == camera.clearance);
            RC_ASSERT(sample.flags._buffer[i] == camera.flags);
        }
    }
}

TEST(EncodeCameraFrame, UsesTheSameMemoryForEveryFrame) {
    CameraFrameEncoder encoder("m", 1);
    const float* const before = encoder.encode(random_camera_frame(3, 1), 0).position._buffer;
    const camera_director_CameraFrame& after = encoder.encode(random_camera_frame(256, 2), 0);
    EXPECT_EQ(after.position._buffer, before);
    EXPECT_FALSE(after.position._release) << "DDS must not free it";
}

RC_GTEST_PROP(EncodeShownMatch, IsDecodedToTheSame, ()) {
    ShownMatchEncoder encoder;
    // The second description must not contain anything of the first.
    for (int round = 0; round < 2; ++round) {
        director::MatchInfo info;
        info.match_id = "cup-7";
        info.epoch = *rc::gen::arbitrary<std::uint64_t>();
        info.map_name = std::string(*rc::gen::inRange<std::size_t>(1, 256), 'm');
        info.map_hash = *rc::gen::arbitrary<std::uint64_t>();
        info.metres_per_unit = 0.0254F;
        info.rate_hz = 60.0F;
        info.spectator_delay_s = 3.5F;
        const auto players = *rc::gen::inRange<std::uint32_t>(0, director::max_players + 1);
        for (std::uint32_t i = 0; i < players; ++i)
            info.players.push_back(
                {i * 7, std::string(i % 64, 'n'), std::string(i % 32, 'c'), static_cast<std::uint8_t>(i)});
        director::MatchInfo decoded;
        const auto sample = test::described_as<camera_director_MatchInfo>(encoder.encode(info));
        RC_ASSERT(!decode(sample, decoded));
        RC_ASSERT(decoded == info);
    }
}

TEST(EncodeShownMatch, CutsStringsBetweenCharacters) {
    director::MatchInfo info;
    info.match_id = "m";
    info.players.push_back({1, std::string(62, 'x') + "ä", std::string(30, 'x') + "ä", 0});
    ShownMatchEncoder encoder;
    const camera_director_ShownMatch& sample = encoder.encode(info);
    EXPECT_EQ(std::string(sample.player_name._buffer[0]), std::string(62, 'x'));
    EXPECT_EQ(std::string(sample.player_class._buffer[0]), std::string(30, 'x'));
}

TEST(EncodeObserverStatus, CutsStringsBetweenCharacters) {
    director::ObserverStatus status;
    status.match_id = "m";
    status.observer_id = "anna";
    status.epoch = 5;
    status.state = director::RequestState::waiting_for_player;
    status.camera_id = 8;
    status.reason = std::string(254, 'x') + "ä";  // two bytes, and only one fits
    camera_director_ObserverStatus sample = encode(status);
    EXPECT_STREQ(sample.observer_id, "anna");
    EXPECT_EQ(sample.epoch, 5U);
    EXPECT_EQ(sample.state, 3U);
    EXPECT_EQ(sample.camera_id, 8U);
    EXPECT_EQ(std::string(sample.reason), std::string(254, 'x'));
    status.reason = std::string(253, 'x') + "ä";
    EXPECT_EQ(std::string(encode(status).reason), status.reason);
}

director::ObserverStatus status_of(const std::string& observer, std::uint32_t camera_id) {
    director::ObserverStatus status;
    status.match_id = "cup";
    status.observer_id = observer;
    status.camera_id = camera_id;
    return status;
}

TEST(EncodeStatusBucket, HoldsTheStatusesOfItsObserversAndNoneOfThoseErased) {
    StatusBuckets statuses;
    const StatusBuckets::Number number = StatusBuckets::number_of("anna");
    std::string neighbour;  // in the same bucket
    for (int i = 0; neighbour.empty(); ++i)
        if (StatusBuckets::number_of(std::to_string(i)) == number) neighbour = std::to_string(i);
    ASSERT_TRUE(statuses.put(status_of("anna", 5)));
    ASSERT_TRUE(statuses.put(status_of(neighbour, 6)));
    ASSERT_TRUE(statuses.put(status_of("anna", 7)));

    StatusBucketEncoder encoder("cup");
    const camera_director_ObserverStatusBucket& sample = encoder.encode(number, statuses.bucket(number));
    EXPECT_STREQ(sample.match_id, "cup");
    EXPECT_EQ(sample.bucket, number);
    ASSERT_EQ(sample.statuses._length, 2U);
    EXPECT_STREQ(sample.statuses._buffer[0].observer_id, neighbour.c_str());
    EXPECT_EQ(sample.statuses._buffer[1].camera_id, 7U);
    EXPECT_TRUE(statuses.erase(neighbour));
    EXPECT_EQ(encoder.encode(number, statuses.bucket(number)).statuses._length, 1U);
    EXPECT_TRUE(statuses.erase("anna"));
    EXPECT_EQ(encoder.encode(number, statuses.bucket(number)).statuses._length, 0U);
    EXPECT_EQ(statuses.used().size(), 1U);
}

TEST(StatusBuckets, AreBounded) {
    StatusBuckets statuses;
    std::vector<std::string> observers;  // of one bucket
    for (int i = 0; observers.size() <= StatusBuckets::max_statuses; ++i)
        if (StatusBuckets::number_of(std::to_string(i)) == 0) observers.push_back(std::to_string(i));
    const auto put = [&](const std::string& observer) { return statuses.put(status_of(observer, 1)); };
    for (std::size_t i = 0; i < StatusBuckets::max_statuses; ++i)
        ASSERT_TRUE(put(observers[i]));
    EXPECT_FALSE(put(observers.back()));
    EXPECT_TRUE(put(observers.front())) << "it is there already";
    EXPECT_TRUE(statuses.erase(observers.front()));
    EXPECT_FALSE(statuses.erase(observers.front())) << "it is gone";
    EXPECT_TRUE(put(observers.back()));
}

TEST(EncodeSign, IsDecodedAsItWas) {
    const Sign sign{.director_id = 7,
                    .term = max_term,
                    .rank = max_rank,
                    .lease = max_lease,
                    .leads = true,
                    .has_cameras = true};
    Sign decoded;
    camera_director_DirectorSign sample = encode("cup", sign);
    EXPECT_STREQ(sample.match_id, "cup");
    EXPECT_FALSE(decode(sample, decoded));
    EXPECT_EQ(decoded, sign);
    sample.term = max_term + 1;
    EXPECT_EQ(decode(sample, decoded), ValidationError::out_of_range);
    sample = encode("cup", sign);
    sample.rank = max_rank + 1;
    EXPECT_EQ(decode(sample, decoded), ValidationError::out_of_range);
    sample = encode("cup", sign);
    for (const std::uint32_t lease_ms : {0U, 60'001U}) {
        sample.lease_ms = lease_ms;
        EXPECT_EQ(decode(sample, decoded), ValidationError::out_of_range);
    }
}

TEST(EncodeCameraFrame, IsDecodedAsItWasAndCountsOn) {
    director::CameraFrame frame;
    frame.epoch = 3;
    frame.frame_number = 0xffffffffU;
    frame.pose_number = 9;
    frame.cameras.resize(2);
    frame.cameras[1] = {.camera_id = 4, .target = 5, .position = {1.0F, 2.0F, 3.0F}, .flags = 1};
    frame.reasons = {{4, {5, 6, "multi-kill"}}, {0, {.why = std::string(40, 'x')}}};
    CameraFrameEncoder encoder("cup", 7);
    camera_director_CameraFrame sample = encoder.encode(frame, 11, 6);
    director::CameraFrame decoded;
    EXPECT_FALSE(decode(sample, decoded));
    EXPECT_EQ(decoded.frame_number, 5U);
    EXPECT_EQ(decoded.pose_number, 9U);
    ASSERT_EQ(decoded.cameras.size(), 2U);
    EXPECT_EQ(decoded.cameras[1].camera_id, 4U);
    EXPECT_EQ(decoded.cameras[1].target, 5U);
    EXPECT_EQ(decoded.cameras[1].position, frame.cameras[1].position);
    EXPECT_EQ(decoded.cameras[1].flags, 1U);

    ASSERT_EQ(decoded.reasons.size(), 2U);
    EXPECT_EQ(decoded.reasons[0].camera_id, 4U);
    EXPECT_EQ(decoded.reasons[0].reason.actor, 5U);
    EXPECT_EQ(decoded.reasons[0].reason.subject, 6U);
    EXPECT_EQ(decoded.reasons[0].reason.why, "multi-kill");
    EXPECT_EQ(decoded.reasons[1].reason.why, std::string(31, 'x'));

    sample.reasons._length = 257;
    EXPECT_EQ(decode(sample, decoded), ValidationError::too_many);
    sample = encoder.encode(frame, 11, 6);
    sample.flags._length = 1;
    EXPECT_EQ(decode(sample, decoded), ValidationError::array_length);
    sample = encoder.encode(frame, 11);
    sample.position._buffer[2] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(decode(sample, decoded), ValidationError::not_finite);
}

}  // namespace
}  // namespace camdir::dds
