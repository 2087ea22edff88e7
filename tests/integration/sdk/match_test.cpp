// The game server's functions against a fake director.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <camera_director/camera_director.hpp>

#include "fake_director.hpp"
#include "support/test_domain.hpp"

namespace camdir::test {
namespace {

namespace cd = camera_director;
using testing::ElementsAre;
using testing::IsEmpty;

class GameServer : public testing::Test {
  protected:
    // Every test has its own match, because tests run concurrently in one domain.
    const std::string match_id_ = testing::UnitTest::GetInstance()->current_test_info()->name();
    cd::Context context_ = cd::Context::open({.domain = shared_domain}).value();

    [[nodiscard]] cd::MatchInfo info() const {
        return {.match_id = match_id_,
                .map_name = "oa_dm1",
                .metres_per_unit = 0.5F,
                .rate_hz = 20.0F,
                .spectator_delay_s = 10.0F,
                .map_hash = 0xfedcba9876543210U,
                .players = {{7, "anna", "medic", 1}, {300, "b\xc3\xa4rt", "", 2}}};
    }

    [[nodiscard]] static cd::PoseFrame one_player(std::int64_t frame_time) {
        static const std::uint32_t id = 7;
        static const std::uint32_t flags = CDIR_POSE_ALIVE;
        static const float eye[3] = {1.0F, 2.0F, 3.0F};
        static const float orientation[4] = {0.0F, 0.0F, 0.6F, 0.8F};
        return {.frame_time = frame_time,
                .player_id = {&id, 1},
                .eye = eye,
                .orientation = orientation,
                .flags = {&flags, 1}};
    }
};

TEST_F(GameServer, PosesArriveAsTheyWerePublished) {
    cd::MatchInfo match_info = info();
    match_info.epoch = 9;
    cd::Match match = cd::Match::open(context_, match_info).value();
    FakeDirector director(shared_domain, match_id_);
    ASSERT_TRUE(eventually([&] { return match.director_count().value() == 1; }));

    const std::uint32_t ids[2] = {7, 300};
    const std::uint32_t flags[2] = {CDIR_POSE_ALIVE, CDIR_POSE_DISCONTINUITY | CDIR_POSE_SPECTATOR};
    const float eye[6] = {1, 2, 3, -4, 5e6F, 6};
    const float orientation[8] = {0, 0, 0, 1, 0.6F, 0, 0.8F, 0};
    const float velocity[6] = {9, 8, 7, 6, 5, 4};
    match
        .publish(cd::PoseFrame{.frame_time = 50'000'000,
                               .source_time = 12345,
                               .player_id = ids,
                               .eye = eye,
                               .orientation = orientation,
                               .velocity = velocity,
                               .flags = flags})
        .value();
    std::optional<ReceivedPoses> poses;
    ASSERT_TRUE(eventually([&] { return (poses = director.take_poses()).has_value(); }));
    EXPECT_EQ(poses->match_id, match_id_);
    EXPECT_EQ(poses->epoch, 9U);
    EXPECT_EQ(poses->frame_number, 0U);
    EXPECT_EQ(poses->frame_time, 50'000'000);
    EXPECT_EQ(poses->source_time, 12345);
    EXPECT_THAT(poses->player_id, ElementsAre(7, 300));
    EXPECT_THAT(poses->eye, testing::ElementsAreArray(eye));
    EXPECT_THAT(poses->orientation, testing::ElementsAreArray(orientation));
    EXPECT_THAT(poses->velocity, testing::ElementsAreArray(velocity));
    EXPECT_THAT(poses->flags, testing::ElementsAreArray(flags));

    const auto before = std::chrono::system_clock::now().time_since_epoch();
    match.publish(one_player(50'000'000)).value();
    ASSERT_TRUE(eventually([&] { return (poses = director.take_poses()).has_value(); }));
    EXPECT_EQ(poses->frame_number, 1U);
    EXPECT_THAT(poses->velocity, IsEmpty());
    EXPECT_GE(poses->source_time, std::chrono::nanoseconds(before).count()) << "filled in by the library";

    match.publish(cd::PoseFrame{.frame_time = 50'000'001}).value();
    ASSERT_TRUE(eventually([&] { return (poses = director.take_poses()).has_value(); }));
    EXPECT_THAT(poses->player_id, IsEmpty());
}

TEST_F(GameServer, DiscontinuitiesAreCountedByPlayerWithinAnEpoch) {
    cd::Match match = cd::Match::open(context_, info()).value();
    FakeDirector director(shared_domain, match_id_);
    ASSERT_TRUE(eventually([&] { return match.director_count().value() == 1; }));
    std::int64_t time = 0;
    const auto publish = [&](std::vector<std::uint32_t> ids, std::vector<std::uint32_t> flags) {
        const std::vector<float> eye(3 * ids.size());
        std::vector<float> orientation;
        for (std::size_t i = 0; i < ids.size(); ++i)
            orientation.insert(orientation.end(), {0.0F, 0.0F, 0.0F, 1.0F});
        match
            .publish(cd::PoseFrame{.frame_time = ++time,
                                   .player_id = ids,
                                   .eye = eye,
                                   .orientation = orientation,
                                   .flags = flags})
            .value();
        std::optional<ReceivedPoses> poses;
        EXPECT_TRUE(eventually([&] { return (poses = director.take_poses()).has_value(); }));
        return poses ? poses->discontinuities : std::vector<std::uint32_t>{};
    };
    constexpr std::uint32_t alive = CDIR_POSE_ALIVE;
    constexpr std::uint32_t jumped = CDIR_POSE_ALIVE | CDIR_POSE_DISCONTINUITY;
    EXPECT_THAT(publish({7, 300}, {alive, jumped}), ElementsAre(0, 1));
    EXPECT_THAT(publish({7, 300}, {alive, alive}), ElementsAre(0, 1));
    EXPECT_THAT(publish({300}, {jumped}), ElementsAre(2));
    EXPECT_THAT(publish({300, 7}, {alive, jumped}), ElementsAre(2, 1)) << "whatever their order";
    EXPECT_THAT(publish({}, {}), IsEmpty());
    EXPECT_THAT(publish({7}, {alive}), ElementsAre(1)) << "also after an absence";
    match.restart(info()).value();
    EXPECT_THAT(publish({7, 300}, {jumped, alive}), ElementsAre(1, 0));
}

TEST_F(GameServer, MoversArriveAsTheyWerePublishedAlsoAtALateDirector) {
    cd::MatchInfo match_info = info();
    match_info.epoch = 9;
    cd::Match match = cd::Match::open(context_, match_info).value();
    const std::vector<cd::Mover> movers = {
        {.id = 30, .model = "*3", .kind = "func_door"},
        {.id = 31,
         .half_spaces = {1, 0, 0, 4, -1, 0, 0, 4, 0, 1, 0, 9, 0, -1, 0, 9, 0, 0, 1, 2, 0, 0, -1, 2},
         .hull_sizes = {6},
         .balls = {0, 0, 20, 30}}};
    match.set_movers(movers).value();
    const std::uint32_t both[2] = {30, 31};
    const float positions[6] = {0, 0, 8, 100, 200, 300};
    const float orientations[8] = {0, 0, 0, 1, 0.6F, 0, 0.8F, 0};
    match
        .publish(cd::MoverFrame{.frame_time = 50,
                                .source_time = 12345,
                                .mover_id = both,
                                .position = positions,
                                .orientation = orientations})
        .value();

    FakeDirector director(shared_domain, match_id_);
    std::optional<ReceivedMovers> received;
    ASSERT_TRUE(eventually([&] { return (received = director.take_movers()).has_value(); }));
    EXPECT_EQ(received->epoch, 9U);
    EXPECT_THAT(received->mover_id, ElementsAre(30, 31));
    EXPECT_THAT(received->model, ElementsAre("*3", ""));
    EXPECT_THAT(received->kind, ElementsAre("func_door", ""));
    EXPECT_THAT(received->hulls, ElementsAre(0, 1));
    EXPECT_THAT(received->half_spaces, ElementsAre(6));
    EXPECT_EQ(received->planes, movers[1].half_spaces);
    EXPECT_THAT(received->balls, ElementsAre(0, 1));
    EXPECT_EQ(received->spheres, movers[1].balls);
    std::optional<ReceivedMoverFrame> frame;
    ASSERT_TRUE(eventually([&] { return (frame = director.take_mover_frame()).has_value(); }));
    EXPECT_EQ(frame->epoch, 9U);
    EXPECT_EQ(frame->frame_time, 50);
    EXPECT_EQ(frame->source_time, 12345);
    EXPECT_THAT(frame->mover_id, ElementsAre(30, 31));
    EXPECT_THAT(frame->position, testing::ElementsAreArray(positions));
    EXPECT_THAT(frame->orientation, testing::ElementsAreArray(orientations));

    const float up[3] = {0, 0, 16};
    const cd::MoverFrame door_alone = {.frame_time = 60,
                                       .mover_id = std::span(both).first(1),
                                       .position = up,
                                       .orientation = std::span(orientations).first(4)};
    match.publish(door_alone).value();
    match.publish(door_alone).value();
    ASSERT_TRUE(eventually([&] { return (frame = director.take_mover_frame()).has_value(); }));
    EXPECT_THAT(frame->position, ElementsAre(0, 0, 16, 100, 200, 300)) << "says where all are";
    match.publish(cd::MoverFrame{.frame_time = 70}).value();
    EXPECT_THROW(match.publish(door_alone).value(), cd::Error) << "the game's clock went back";

    match_info.epoch = 10;
    match.restart(match_info).value();
    EXPECT_THROW(match.publish(door_alone).value(), cd::Error) << "the epoch has no movers yet";
    match.set_movers(movers).value();
    match.publish(door_alone).value();
    ASSERT_TRUE(eventually([&] { return (frame = director.take_mover_frame()).has_value(); }));
    EXPECT_EQ(frame->epoch, 10U) << "nothing was sent in between: nothing had moved";
    EXPECT_THAT(frame->mover_id, ElementsAre(30));
}

TEST_F(GameServer, RefusedFrameIsNotCounted) {
    cd::Match match = cd::Match::open(context_, info()).value();
    FakeDirector director(shared_domain, match_id_);
    ASSERT_TRUE(eventually([&] { return match.director_count().value() == 1; }));
    match.publish(one_player(100)).value();
    EXPECT_THROW(match.publish(one_player(99)).value(), cd::Error) << "the game's clock went back";
    match.publish(one_player(101)).value();
    std::optional<ReceivedPoses> poses;
    ASSERT_TRUE(eventually([&] {
        if (auto taken = director.take_poses()) poses = taken;
        return poses && poses->frame_time == 101;
    }));
    EXPECT_EQ(poses->frame_number, 1U);
}

TEST_F(GameServer, ALateDirectorReceivesTheMatchAndItsEnd) {
    std::optional<cd::Match> match = cd::Match::open(context_, info()).value();
    FakeDirector director(shared_domain, match_id_);
    std::optional<ReceivedInfo> received;
    ASSERT_TRUE(eventually([&] { return (received = director.take_info()).has_value(); }));
    EXPECT_EQ(received->map_name, "oa_dm1");
    EXPECT_EQ(received->map_hash, 0xfedcba9876543210U);
    EXPECT_EQ(received->metres_per_unit, 0.5F);
    EXPECT_EQ(received->rate_hz, 20.0F);
    EXPECT_EQ(received->spectator_delay_s, 10.0F);
    EXPECT_THAT(received->player_id, ElementsAre(7, 300));
    EXPECT_THAT(received->player_name, ElementsAre("anna", "b\xc3\xa4rt"));
    EXPECT_THAT(received->player_class, ElementsAre("medic", ""));
    EXPECT_THAT(received->player_team, ElementsAre(1, 2));
    EXPECT_FALSE(director.info_has_ended());
    match.reset();
    EXPECT_TRUE(eventually([&] { return director.info_has_ended(); }));
}

TEST_F(GameServer, UpdateKeepsTheEpochAndRestartBeginsAnother) {
    cd::Match match = cd::Match::open(context_, info()).value();
    FakeDirector director(shared_domain, match_id_);
    ASSERT_TRUE(eventually([&] { return match.director_count().value() == 1; }));
    std::optional<ReceivedInfo> first;
    ASSERT_TRUE(eventually([&] { return (first = director.take_info()).has_value(); }));
    match.publish(one_player(1000)).value();

    cd::MatchInfo changed = info();
    changed.players.push_back({8, "carl", "", 1});
    match.update(changed).value();
    std::optional<ReceivedInfo> second;
    ASSERT_TRUE(eventually([&] { return (second = director.take_info()).has_value(); }));
    EXPECT_EQ(second->epoch, first->epoch);
    EXPECT_EQ(match.epoch().value(), first->epoch);
    EXPECT_THAT(second->player_id, ElementsAre(7, 300, 8));

    changed.map_name = "oa_dm3";
    EXPECT_THROW(match.update(changed).value(), cd::Error) << "another map needs a restart";
    match.restart(changed).value();
    std::optional<ReceivedInfo> third;
    ASSERT_TRUE(eventually([&] { return (third = director.take_info()).has_value(); }));
    EXPECT_GT(third->epoch, first->epoch);
    EXPECT_EQ(match.epoch().value(), third->epoch);
    EXPECT_EQ(third->map_name, "oa_dm3");

    while (director.take_poses()) {
    }
    match.publish(one_player(10)).value();  // the game's clock starts again with the epoch
    std::optional<ReceivedPoses> poses;
    ASSERT_TRUE(eventually([&] { return (poses = director.take_poses()).has_value(); }));
    EXPECT_EQ(poses->epoch, third->epoch);
    EXPECT_EQ(poses->frame_number, 0U);

    changed.epoch = third->epoch;
    EXPECT_THROW(match.restart(changed).value(), cd::Error) << "an epoch is used once";
}

TEST_F(GameServer, EpochOfALaterProcessIsGreater) {
    const auto epoch = [&] {
        cd::Match match = cd::Match::open(context_, info()).value();
        FakeDirector director(shared_domain, match_id_);
        std::optional<ReceivedInfo> received;
        EXPECT_TRUE(eventually([&] { return (received = director.take_info()).has_value(); }));
        return received ? received->epoch : 0;
    };
    const std::uint64_t first = epoch();
    EXPECT_LT(first, epoch());
}

TEST_F(GameServer, EventsAllArriveInOrder) {
    cd::Match match = cd::Match::open(context_, info()).value();
    FakeDirector director(shared_domain, match_id_);
    ASSERT_TRUE(eventually([&] { return match.director_count().value() == 1; }));
    // The event writer is matched independently of the pose writer.
    ASSERT_TRUE(eventually([&] {
        match.publish(cd::MatchEvent{.kind = CDIR_EVENT_AWARD}).value();
        return director.take_event().has_value();
    }));
    while (director.take_event()) {
    }
    const auto detail = [](std::uint32_t i) { return std::string(i % 32, 'x'); };
    for (std::uint32_t i = 0; i < 200; ++i) {
        match
            .publish(cd::MatchEvent{.kind = CDIR_EVENT_KILL,
                                    .frame_time = i,
                                    .actor = i,
                                    .subject = i + 1,
                                    .value = 0.5F,
                                    .detail = detail(i)})
            .value();
    }
    for (std::uint32_t i = 0; i < 200; ++i) {
        std::optional<camera_director_MatchEvent> event;
        ASSERT_TRUE(eventually([&] { return (event = director.take_event()).has_value(); }));
        EXPECT_EQ(event->frame_time, i);
        EXPECT_EQ(event->kind, 1U);
        EXPECT_EQ(event->actor, i);
        EXPECT_EQ(event->subject, i + 1);
        EXPECT_EQ(event->value, 0.5F);
        EXPECT_EQ(event->detail, detail(i));
    }
}

TEST_F(GameServer, ADetailThatIsTooLongIsRefused) {
    cd::Match match = cd::Match::open(context_, info()).value();
    for (const std::string& wrong : {std::string(32, 'x'), std::string("a\0b", 3)}) {
        try {
            match.publish(cd::MatchEvent{.detail = wrong}).value();
            ADD_FAILURE() << "published";
        } catch (const cd::Error& error) {
            EXPECT_EQ(error.status(), CDIR_INVALID_ARGUMENT);
            EXPECT_STREQ(error.what(), "an event's detail must have at most 31 bytes, none of them zero");
        }
    }
}

TEST_F(GameServer, WritersOfferTheContractsQualityOfService) {
    cd::Match match = cd::Match::open(context_, info()).value();
    cd::Observer observer = cd::Observer::open(context_, match_id_, "anna").value();
    FakeDirector director(shared_domain, match_id_);
    int looked = 0;
    const auto expect = [&](const char* topic, dds_reliability_kind_t reliability,
                            dds_durability_kind_t durability, dds_history_kind_t history, std::int32_t depth,
                            dds_duration_t lease) {
        director.with_offered_qos(topic, [&](const dds_qos_t* qos) {
            ++looked;
            dds_reliability_kind_t offered_reliability{};
            dds_durability_kind_t offered_durability{};
            dds_history_kind_t offered_history{};
            std::int32_t offered_depth = 0;
            dds_liveliness_kind_t offered_liveliness{};
            dds_duration_t offered_lease = 0;
            dds_qget_reliability(qos, &offered_reliability, nullptr);
            dds_qget_durability(qos, &offered_durability);
            dds_qget_history(qos, &offered_history, &offered_depth);
            dds_qget_liveliness(qos, &offered_liveliness, &offered_lease);
            EXPECT_EQ(offered_reliability, reliability) << topic;
            EXPECT_EQ(offered_durability, durability) << topic;
            EXPECT_EQ(offered_history, history) << topic;
            EXPECT_TRUE(depth == 0 || offered_depth == depth) << topic;
            EXPECT_EQ(offered_liveliness, DDS_LIVELINESS_AUTOMATIC) << topic;
            EXPECT_EQ(offered_lease, lease) << topic;
        });
    };
    ASSERT_TRUE(eventually([&] { return match.director_count().value() == 1 && director.take_info(); }));
    observer.request({}).value();
    ASSERT_TRUE(eventually([&] { return director.take_request().has_value(); }));
    const std::vector<cd::Mover> mover = {{.id = 1, .model = "*1"}};
    const std::uint32_t id = 1;
    const float pose[] = {0, 0, 0, 1};
    match.set_movers(mover).value();
    match
        .publish(
            cd::MoverFrame{.mover_id = {&id, 1}, .position = std::span(pose).first(3), .orientation = pose})
        .value();
    ASSERT_TRUE(eventually([&] { return director.take_movers().has_value(); }));
    ASSERT_TRUE(eventually([&] { return director.take_mover_frame().has_value(); }));
    for (const char* topic : {"MoverInfo", "MoverFrame"})
        expect(topic, DDS_RELIABILITY_RELIABLE, DDS_DURABILITY_TRANSIENT_LOCAL, DDS_HISTORY_KEEP_LAST, 1,
               DDS_INFINITY);
    expect("MatchInfo", DDS_RELIABILITY_RELIABLE, DDS_DURABILITY_TRANSIENT_LOCAL, DDS_HISTORY_KEEP_LAST, 1,
           DDS_SECS(2));
    expect("PoseFrame", DDS_RELIABILITY_BEST_EFFORT, DDS_DURABILITY_VOLATILE, DDS_HISTORY_KEEP_LAST, 1,
           DDS_INFINITY);
    expect("MatchEvent", DDS_RELIABILITY_RELIABLE, DDS_DURABILITY_VOLATILE, DDS_HISTORY_KEEP_ALL, 0,
           DDS_INFINITY);
    expect("ObserverRequest", DDS_RELIABILITY_RELIABLE, DDS_DURABILITY_TRANSIENT_LOCAL, DDS_HISTORY_KEEP_LAST,
           1, DDS_SECS(10));
    EXPECT_EQ(looked, 6);
}

}  // namespace
}  // namespace camdir::test
