// Maps, epochs, silence and the end of matches.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>

#include "stage.hpp"
#include "support/eventually.hpp"
#include "support/freespace_meshes.hpp"

namespace camdir::director {
namespace {

using test::eventually;
using testing::HasSubstr;

MatchInfo on_map(const std::string& map_name, std::uint64_t epoch = 1) {
    MatchInfo info = Stage::info("m", epoch);
    info.map_name = map_name;
    return info;
}

TEST(MatchLife, ARequestWaitsForAnUnknownMap) {
    Stage stage;
    stage.start(on_map("nowhere"));
    stage.ask(Stage::request("a"));
    EXPECT_EQ(stage.publisher.status("a").state, RequestState::waiting_for_map);
    EXPECT_EQ(stage.publisher.status("a").reason, "map 'nowhere' is not configured; known: square");
    stage.send(Stage::poses(1));
    EXPECT_TRUE(stage.publisher.frames().empty());
    EXPECT_EQ(stage.director.statistics()[Counter::drop_waiting], 1U);

    stage.maps.set_loading("nowhere", "baking: sample 3 %");
    stage.director.maps_changed();
    stage.director.flush();
    EXPECT_EQ(stage.publisher.status("a").reason, "map 'nowhere' is loading: baking: sample 3 %");

    stage.maps.set_failed("nowhere", "no obstacles");
    stage.director.maps_changed();
    stage.director.flush();
    EXPECT_EQ(stage.publisher.status("a").reason, "map 'nowhere' failed: no obstacles");

    stage.maps.set_ready("nowhere", Stage::square());
    stage.director.maps_changed();
    stage.director.flush();
    EXPECT_EQ(stage.publisher.status("a").state, RequestState::accepted);
    stage.send(Stage::poses(2));
    EXPECT_EQ(stage.publisher.frames().size(), 1U);
}

TEST(MatchLife, ANewMapFileCutsAndAnUnchangedOneDoesNot) {
    Stage stage;
    stage.start();
    stage.ask(Stage::request("a"));
    stage.send(Stage::poses(1));
    stage.director.maps_changed();
    stage.send(Stage::poses(2));
    EXPECT_FALSE(cuts(stage.publisher.frames().back()));
    stage.maps.set_ready("square", Stage::square());
    stage.director.maps_changed();
    stage.send(Stage::poses(3));
    EXPECT_TRUE(cuts(stage.publisher.frames().back()));
    stage.maps.set_failed("square", "damaged by the reload");
    stage.director.maps_changed();
    stage.send(Stage::poses(4));
    EXPECT_EQ(stage.publisher.frames().size(), 4U) << "the map loaded before stays in use";
    stage.maps.remove("square");
    stage.director.maps_changed();
    stage.send(Stage::poses(5));
    EXPECT_EQ(stage.publisher.frames().size(), 4U);
    EXPECT_EQ(stage.publisher.status("a").state, RequestState::waiting_for_map);
}

TEST(MatchLife, TheMatchIsDescribedWithoutRequestsAndWithoutItsMap) {
    Stage stage;
    stage.start(on_map("nowhere"));
    ASSERT_TRUE(stage.publisher.shown());
    EXPECT_EQ(stage.publisher.shown()->map_name, "nowhere");
    EXPECT_EQ(stage.publisher.shown()->players.size(), 3U);
    stage.start(Stage::info("m", 1, {1}));
    EXPECT_EQ(stage.publisher.shown()->players.size(), 1U);
    stage.start(Stage::info("m", 0));
    EXPECT_EQ(stage.publisher.shown()->epoch, 1U) << "an older one is not shown";
    stage.director.server_lost("m");
    stage.director.flush();
    EXPECT_TRUE(stage.publisher.shown()) << "it may go on";
    stage.director.match_ended("m");
    stage.director.flush();
    EXPECT_FALSE(stage.publisher.shown());
}

TEST(MatchLife, ANewEpochRestartsEveryShot) {
    Stage stage;
    stage.start();
    stage.ask(Stage::request("a"));
    stage.send(Stage::poses(7));
    stage.send(Stage::poses(8));
    stage.send(Stage::poses(1, 2));  // its MatchInfo has not arrived
    EXPECT_EQ(stage.director.statistics()[Counter::drop_early_epoch], 1U);

    stage.start(Stage::info("m", 2));
    EXPECT_EQ(stage.publisher.status("a").epoch, 2U);
    stage.send(Stage::poses(9, 1));
    stage.start(Stage::info("m", 1));
    EXPECT_EQ(stage.director.statistics()[Counter::drop_old_epoch], 2U);
    stage.send(Stage::poses(2, 2));
    const auto frames = stage.publisher.frames();
    ASSERT_EQ(frames.size(), 3U);
    EXPECT_EQ(frames[1].frame_number, 1U);
    EXPECT_EQ(frames[2].frame_number, 0U);
    EXPECT_EQ(frames[2].epoch, 2U);
    EXPECT_EQ(frames[2].cameras.at(0).camera_id, frames[0].cameras.at(0).camera_id);
    EXPECT_TRUE(cuts(frames[2]));
    EXPECT_FALSE(cuts(frames[1]));
}

TEST(MatchLife, OldFramesAreDropped) {
    Stage stage;
    stage.start();
    stage.ask(Stage::request("a"));
    for (const std::uint32_t number : {0xfffffffeU, 0xfffffffeU, 0xfffffff0U, 1U, 0xffffffffU, 2U})
        stage.send(Stage::poses(number));
    const auto frames = stage.publisher.frames();
    ASSERT_EQ(frames.size(), 3U);
    EXPECT_EQ(frames[0].pose_number, 0xfffffffeU);
    EXPECT_EQ(frames[1].pose_number, 1U) << "numbers may wrap";
    EXPECT_EQ(frames[2].pose_number, 2U);
    EXPECT_EQ(stage.director.statistics()[Counter::drop_old_frame], 3U);
}

TEST(MatchLife, MessagesOfUnknownMatchesAreDropped) {
    Stage stage;
    stage.send(Stage::poses(1));
    stage.director.receive("m", MatchEvent{});
    stage.director.request_ended("m", "a");
    stage.director.server_lost("m");
    stage.director.match_ended("m");
    stage.director.flush();
    EXPECT_EQ(stage.director.statistics()[Counter::drop_unknown_match], 2U);
    EXPECT_EQ(stage.director.statistics().matches, 0U);
}

TEST(MatchLife, ALostServerCanReturn) {
    Stage stage;
    stage.start();
    stage.ask(Stage::request("a"));
    stage.send(Stage::poses(1));
    stage.send(Stage::poses(2));
    stage.director.server_lost("m");
    stage.director.flush();
    EXPECT_EQ(stage.publisher.status("a").state, RequestState::accepted);
    EXPECT_THAT(stage.publisher.status("a").reason, HasSubstr("silent"));
    EXPECT_EQ(stage.director.statistics().silent_matches, 1U);
    EXPECT_EQ(stage.publisher.frames().size(), 2U);

    stage.send(Stage::poses(1));  // a restarted server counts from 0 or 1
    EXPECT_EQ(stage.publisher.status("a").reason, "");
    EXPECT_EQ(stage.director.statistics().silent_matches, 0U);
    EXPECT_EQ(stage.director.statistics()[Counter::silences], 1U);
    const auto frames = stage.publisher.frames();
    ASSERT_EQ(frames.size(), 3U);
    EXPECT_EQ(frames[2].frame_number, 2U);
    EXPECT_TRUE(cuts(frames[2])) << "players may have moved anywhere";
    stage.send(Stage::poses(2));
    EXPECT_FALSE(cuts(stage.publisher.frames().back()));
}

TEST(MatchLife, MissingPosesAreNoticed) {
    config::Config config = Stage::default_config();
    config.matches.silence_frames = 1;
    Stage stage(config);
    stage.start();
    stage.ask(Stage::request("a"));
    EXPECT_TRUE(eventually([&] { return stage.director.statistics()[Counter::silences] == 1; }));
    EXPECT_TRUE(eventually([&] { return !stage.publisher.status("a").reason.empty(); }));
    stage.send(Stage::poses(1));
    EXPECT_EQ(stage.publisher.frames().size(), 1U);
    EXPECT_TRUE(eventually([&] { return stage.director.statistics()[Counter::silences] == 2; }));
    EXPECT_EQ(stage.director.statistics().matches, 1U) << "kept because its server is alive";
}

TEST(MatchLife, AnEndedMatchIsForgottenOnceItHasNoObservers) {
    Stage stage;
    stage.start();
    stage.ask(Stage::request("a"));
    stage.send(Stage::poses(1));
    stage.director.match_ended("m");
    stage.director.flush();
    EXPECT_EQ(stage.publisher.status("a").state, RequestState::waiting_for_map);
    EXPECT_EQ(stage.publisher.status("a").reason, "no game server runs this match");
    EXPECT_EQ(stage.director.statistics().matches, 0U);
    stage.send(Stage::poses(2));
    EXPECT_EQ(stage.publisher.frames().size(), 1U);

    stage.start();
    EXPECT_EQ(stage.publisher.status("a").state, RequestState::accepted);
    stage.director.match_ended("m");
    stage.director.flush();
    EXPECT_FALSE(stage.publisher.forgotten("m"));
    stage.director.request_ended("m", "a");
    EXPECT_TRUE(eventually([&] { return stage.publisher.forgotten("m"); }));
    EXPECT_EQ(stage.director.statistics()[Counter::pose_frames], 1U) << "counters outlast the match";
    EXPECT_TRUE(stage.director.view(std::chrono::seconds(30)).matches.empty());
}

TEST(MatchLife, ALostServersMatchIsForgottenAfterATime) {
    config::Config config = Stage::default_config();
    config.matches.forget_s = 0.05;
    Stage stage(config);
    stage.start();
    stage.send(Stage::poses(1));
    stage.director.server_lost("m");
    EXPECT_TRUE(eventually([&] { return stage.publisher.forgotten("m"); }));
}

TEST(MatchLife, ALostServersMatchThatHasObserversIsGivenUpAndGoesOnWhenItIsDescribedAgain) {
    config::Config config = Stage::default_config();
    config.matches.forget_s = 0.05;
    Stage stage(config);
    stage.start();
    stage.ask(Stage::request("a"));
    stage.send(Stage::poses(1));
    stage.director.server_lost("m");
    EXPECT_TRUE(eventually([&] { return stage.publisher.given_up("m"); }));
    stage.director.flush();
    EXPECT_FALSE(stage.publisher.forgotten("m"));
    EXPECT_FALSE(stage.publisher.shown());
    stage.start();
    stage.send(Stage::poses(2));
    EXPECT_EQ(stage.publisher.frames().size(), 2U);
}

TEST(MatchLife, AnotherMapFileIsReportedOrRefused) {
    freespace::Contents contents = test::square_contents();
    contents.metadata.source_hash = 7;
    Stage stage;
    stage.maps.set_ready("square", test::make_freespace(contents));
    MatchInfo info = Stage::info();
    info.map_hash = 8;
    stage.start(info);
    stage.ask(Stage::request("a"));
    EXPECT_EQ(stage.publisher.status("a").state, RequestState::accepted);
    EXPECT_EQ(stage.director.statistics()[Counter::map_hash_mismatches], 1U);

    stage.maps.add("square", true);
    stage.start(info);
    EXPECT_EQ(stage.publisher.status("a").state, RequestState::refused);
    EXPECT_THAT(stage.publisher.status("a").reason, HasSubstr("is not the one that was baked"));
    stage.start(info);
    EXPECT_EQ(stage.director.statistics()[Counter::refused_matches_map], 1U);
    info.map_hash = 7;
    stage.start(info);
    EXPECT_EQ(stage.publisher.status("a").state, RequestState::accepted);
}

TEST(MatchLife, AnotherLengthOfAUnitIsReportedOnce) {
    Stage stage;
    const auto mismatches = [&] { return stage.director.statistics()[Counter::scale_mismatches]; };
    MatchInfo info = Stage::info();
    stage.start(info);
    info.metres_per_unit = 0.0F;
    stage.start(info);
    EXPECT_EQ(mismatches(), 0U) << "the same, and an unknown one";
    info.metres_per_unit = 1.0F;
    stage.start(info);
    stage.start(info);
    EXPECT_EQ(mismatches(), 1U);
    stage.ask(Stage::request("a"));
    EXPECT_EQ(stage.publisher.status("a").state, RequestState::accepted);
}

TEST(MatchLife, ObserversAreToldTheMapsScaleWhereTheGameServerDoesNotKnowIt) {
    Stage stage;
    MatchInfo info = Stage::info();
    const float baked = stage.maps.find(info.map_name)->freespace->metadata().metres_per_unit;
    info.metres_per_unit = 0.0F;
    info.map_name = "hall";
    stage.start(info);
    EXPECT_EQ(stage.publisher.shown()->metres_per_unit, 0.0F) << "no such map";
    stage.maps.add("hall", false);
    stage.maps.set_ready("hall", Stage::square());
    stage.director.maps_changed();
    stage.director.flush();
    EXPECT_EQ(stage.publisher.shown()->metres_per_unit, baked);
    info.map_name = Stage::info().map_name;
    ++info.epoch;
    stage.start(info);
    EXPECT_EQ(stage.publisher.shown()->metres_per_unit, baked);
}

TEST(MatchLife, TheViewHasThePlayersAndTheLastEventOfTheEpoch) {
    Stage stage;
    const auto view = [&] { return stage.director.view(std::chrono::seconds(30)).matches.at(0); };
    MatchInfo info = Stage::info();
    info.players[0] = {1, "anarki", "scout", 2};
    stage.start(info);
    EXPECT_EQ(view().players, info.players);
    EXPECT_FALSE(view().last_event);
    stage.director.receive(
        "m", MatchEvent{.epoch = 1, .kind = 5, .actor = 1, .subject = 2, .value = 80.0F, .detail = "rail"});
    stage.director.flush();
    ASSERT_TRUE(view().last_event);
    EXPECT_EQ(view().last_event->actor, 1U);
    EXPECT_EQ(view().last_event->value, 80.0F);
    EXPECT_EQ(view().last_event->detail, "rail");
    stage.start(Stage::info("m", 2));
    EXPECT_FALSE(view().last_event);
}

TEST(MatchLife, NothingIsPublishedAfterTheDrain) {
    Stage stage;
    stage.start();
    stage.ask(Stage::request("a"));
    receive(stage.director, "m", Stage::poses(1));
    stage.director.drain();
    const std::size_t frames = stage.publisher.frames().size();
    EXPECT_EQ(frames, 1U) << "queued frames are processed";
    EXPECT_FALSE(stage.director.receive(Stage::info("other")));
    receive(stage.director, "m", Stage::poses(2));
    stage.director.receive(Stage::request("b"));
    stage.director.maps_changed();
    stage.director.drain();
    EXPECT_EQ(stage.publisher.frames().size(), frames);
    EXPECT_FALSE(stage.publisher.has_status("b"));
    EXPECT_EQ(stage.director.statistics()[Counter::camera_frames], 1U);
}

TEST(MatchLife, TheMatchesThatBeganFirstHaveStatisticsOfTheirOwnUntilTheyEnd) {
    Stage stage;
    const auto shown = [&](std::size_t max) {
        std::vector<std::string> ids;
        for (const MatchStatistics& match : stage.director.match_statistics(max))
            ids.push_back(match.match_id);
        return ids;
    };
    stage.ask(Stage::request("o", 1, "nobody's"));
    for (const char* match_id : {"c", "a", "b"})
        ASSERT_TRUE(stage.start(Stage::info(match_id)));
    EXPECT_THAT(shown(0), testing::IsEmpty());
    EXPECT_THAT(shown(2), testing::ElementsAre("c", "a"));
    EXPECT_THAT(shown(9), testing::ElementsAre("c", "a", "b"));
    stage.ask(Stage::request("o", 1, "a"));
    stage.send(Stage::poses(1), "a");
    const Statistics statistics = stage.director.match_statistics(2).at(1).statistics;
    EXPECT_EQ(statistics[Counter::pose_frames], 1U);
    EXPECT_EQ(statistics[Counter::cameras], 1U);
    EXPECT_EQ(statistics.observers, 1U);
    stage.director.match_ended("c");
    EXPECT_THAT(shown(2), testing::ElementsAre("a", "b"));
    ASSERT_TRUE(stage.start(Stage::info("c", 2)));
    EXPECT_THAT(shown(9), testing::ElementsAre("a", "b", "c"));
}

// Keeps whoever says that a match is forgotten, while it is told to.
class HoldingPublisher final : public MemoryPublisher {
  public:
    void forget(const std::string& match_id) override {
        held.wait(true);
        MemoryPublisher::forget(match_id);
    }
    std::atomic<bool> held{true};
};

TEST(MatchLife, HousekeepingThatHangsIsNotResponsiveUntilItGoesOn) {
    HoldingPublisher publisher;
    MapLibrary maps;
    Director director(Stage::default_config(), maps, publisher);
    EXPECT_TRUE(director.responsive(test::patience));
    ASSERT_TRUE(director.receive(Stage::info()));
    director.match_ended("m");
    EXPECT_TRUE(eventually([&] { return !director.responsive(std::chrono::milliseconds(50)); }));
    publisher.held = false;
    publisher.held.notify_all();
    EXPECT_TRUE(eventually([&] { return publisher.forgotten("m"); }));
    EXPECT_TRUE(eventually([&] { return director.responsive(std::chrono::milliseconds(50)); }));
}

}  // namespace
}  // namespace camdir::director
