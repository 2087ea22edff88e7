#include "live/relay.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "live/history.hpp"

namespace camdir::live {
namespace {

using nlohmann::json;

director::MatchInfo match_info(const std::string& match_id, std::vector<director::Player> players,
                               std::uint64_t epoch = 1) {
    director::MatchInfo info;
    info.match_id = match_id;
    info.epoch = epoch;
    info.map_name = "hall";
    info.metres_per_unit = 0.0254F;
    info.rate_hz = 60.0F;
    info.players = std::move(players);
    return info;
}

director::PoseFrame poses_of(const std::vector<std::uint32_t>& players, std::uint32_t number,
                             std::uint32_t flags = 1) {
    director::PoseFrame poses{1, number, number * 16'000'000LL, 0, {}};
    for (const std::uint32_t player : players) {
        director::PlayerPose pose;
        pose.player_id = player;
        pose.flags = flags;
        poses.poses.push_back(pose);
    }
    return poses;
}

director::CameraFrame cameras_of(const director::PoseFrame& poses, std::uint32_t target,
                                 std::uint32_t flags) {
    director::CameraFrame frame{poses.epoch, 0, poses.frame_number, poses.frame_time, poses.source_time,
                                {},          {}};
    director::ShotCamera camera;
    camera.camera_id = 5;
    camera.target = target;
    camera.flags = flags;
    frame.cameras = {camera};
    return frame;
}

director::MatchEvent event_of(std::uint32_t number, std::uint32_t kind) {
    return {1, number * 16'000'000LL, kind, 1, director::no_player, 1.0F, ""};
}

std::shared_ptr<Viewer> viewer() {
    return std::make_shared<Viewer>([] {});
}

// Notes as JSON, frames as the number of their bytes.
std::vector<json> take_all(Viewer& viewer) {
    std::vector<json> taken;
    while (const SharedMessage message = viewer.take())
        taken.push_back(message->kind == Message::Kind::note ? json::parse(message->content)
                                                             : json(message->content.size()));
    return taken;
}

constexpr std::size_t frame_bytes = 28 + 14 + 22;

TEST(Relay, TellsALateJoinerTheMatchItsHistoryAndTheLastFrame) {
    Relay relay(10);
    relay.show(match_info("cup", {{7, "Ann", "medic", 2}}));
    const auto first = poses_of({7}, 1);
    relay.show("cup", first, cameras_of(first, 7, 1 | 2));
    const auto second = poses_of({7}, 2);
    relay.show("cup", second, cameras_of(second, 7, 4));
    relay.show("cup", director::MatchEvent{1, 30'000'000, 1, 7, director::no_player, 1.0F, "MOD\xff"});

    const auto late = viewer();
    ASSERT_EQ(relay.join("cup", late), Relay::Admission::joined);
    const auto told = take_all(*late);
    ASSERT_EQ(told.size(), 3U);
    EXPECT_EQ(told[0]["kind"], "match");
    EXPECT_EQ(told[0]["version"], 1);
    EXPECT_EQ(told[0]["map"], "hall");
    EXPECT_EQ(told[0]["players"],
              json::parse(R"([{"slot":0,"id":7,"listed":true,"name":"Ann","class":"medic","team":2}])"));
    EXPECT_EQ(told[1]["kind"], "history");
    EXPECT_EQ(told[1]["states"], json::parse("[[16.0,5,0,2],[32.0,5,0,4]]"));
    ASSERT_EQ(told[1]["notes"].size(), 2U);
    EXPECT_EQ(told[1]["notes"][0],
              json::parse(R"({"kind":"cut","t":16.0,"camera":5,"target":0,"reason":"begin"})"));
    EXPECT_EQ(told[1]["notes"][1]["event"], "kill");
    EXPECT_EQ(told[1]["notes"][1]["subject"], nullptr);
    EXPECT_EQ(told[2], frame_bytes);
}

// Of id 4 with one ball, and of those ids as well.
std::shared_ptr<const director::MoverInfo> mover_info(const std::vector<std::uint32_t>& more = {}) {
    director::MoverInfo info{1, {}};
    director::Mover lift;
    lift.id = 4;
    lift.shape.name = "*2";
    lift.shape.kind = "func_plat";
    lift.shape.balls = {{Vec3f(1.0F, 2.0F, 3.0F), 16.0F}};
    info.movers = {lift};
    for (const std::uint32_t id : more)
        info.movers.push_back({id, {}});
    return std::make_shared<director::MoverInfo>(info);
}

director::PoseFrame among(director::PoseFrame poses, const std::shared_ptr<const director::MoverInfo>& info,
                          const std::vector<std::uint32_t>& moved) {
    director::MoverFrame frame{1, poses.frame_time, 0, {}};
    for (const std::uint32_t id : moved)
        frame.poses.push_back(
            {id, Vec3f::Constant(static_cast<float>(poses.frame_number)), Quatf::Identity()});
    poses.movers = std::make_shared<director::MatchMovers>(
        director::MatchMovers{info, std::make_shared<director::MoverFrame>(frame)});
    return poses;
}

TEST(Relay, TellsOfMoversBeforeTheFrameThatHasThem) {
    Relay relay(10);
    relay.show(match_info("cup", {{7, "Ann", "", 2}}));
    const auto watching = viewer();
    EXPECT_EQ(relay.join("cup", watching), Relay::Admission::joined);
    take_all(*watching);
    const auto info = mover_info();
    auto poses = among(poses_of({7}, 1), info, {4, 99});
    relay.show("cup", poses, cameras_of(poses, 7, 2));
    const auto taken = take_all(*watching);
    ASSERT_EQ(taken.size(), 3U);
    EXPECT_EQ(taken[0], json::parse(R"({"kind": "movers", "movers": [{"id": 4, "name": "*2", )"
                                    R"("kind": "func_plat", "hulls": [], "balls": [[1, 2, 3, 16]]}]})"));
    EXPECT_EQ(taken[1]["kind"], "cut");
    constexpr std::size_t mover_bytes = 18;
    EXPECT_EQ(taken[2], frame_bytes + mover_bytes) << "none that was not announced";

    poses = among(poses_of({7}, 2), info, {});
    relay.show("cup", poses, cameras_of(poses, 7, 2));
    EXPECT_EQ(take_all(*watching), std::vector<json>{frame_bytes + mover_bytes}) << "it stands where it was";

    const auto late = viewer();
    EXPECT_EQ(relay.join("cup", late), Relay::Admission::joined);
    const auto told = take_all(*late);
    ASSERT_EQ(told.size(), 4U);
    EXPECT_EQ(told[2], taken[0]);
    EXPECT_EQ(told[3], frame_bytes + mover_bytes);

    poses = among(poses_of({7}, 3), mover_info({5}), {5});
    relay.show("cup", poses, cameras_of(poses, 7, 2));
    const auto more = take_all(*watching);
    ASSERT_EQ(more.size(), 2U);
    EXPECT_EQ(more[0]["movers"].size(), 2U);
    EXPECT_EQ(more[1], frame_bytes + 2 * mover_bytes);

    poses = poses_of({7}, 4);
    relay.show("cup", poses, cameras_of(poses, 7, 2));
    EXPECT_EQ(take_all(*watching),
              (std::vector<json>{json::parse(R"({"kind": "movers", "movers": []})"), frame_bytes}));
}

TEST(Relay, ForgetsTheMoversOfAnEpochThatIsOver) {
    Relay relay(10);
    relay.show(match_info("cup", {{7, "Ann", "", 2}}));
    const auto poses = among(poses_of({7}, 1), mover_info(), {4});
    relay.show("cup", poses, cameras_of(poses, 7, 2));
    relay.show(match_info("cup", {{7, "Ann", "", 2}}, 2));
    const auto late = viewer();
    EXPECT_EQ(relay.join("cup", late), Relay::Admission::joined);
    for (const json& message : take_all(*late)) {
        EXPECT_FALSE(message.is_object() && message["kind"] == "movers");
    }
}

TEST(Relay, SaysWhyAShotWasCut) {
    Relay relay(10);
    relay.show(match_info("cup", {{1, "", "", 0}, {2, "", "", 0}}));
    const auto watcher = viewer();
    ASSERT_EQ(relay.join("cup", watcher), Relay::Admission::joined);
    const auto show = [&](std::uint32_t number, std::uint32_t target, std::uint32_t flags,
                          std::uint32_t pose_flags = 1) {
        const auto poses = poses_of({1, 2}, number, pose_flags);
        relay.show("cup", poses, cameras_of(poses, target, flags));
    };
    show(1, 1, 1 | 2);     // begins
    show(2, 2, 1 | 2);     // another player
    show(3, 2, 1 | 2, 3);  // respawned
    show(4, 2, 0);         // no cut
    show(5, 2, 1 | 2);     // was hidden
    show(6, 2, 1 | 2);     // was visible
    std::vector<std::string> reasons;
    for (const json& note : take_all(*watcher))
        if (note.is_object() && note["kind"] == "cut") reasons.push_back(note["reason"]);
    EXPECT_EQ(reasons, (std::vector<std::string>{"begin", "target", "moved", "hidden", "viewpoint"}));
}

TEST(Relay, NamesTheMomentForWhichAnAutomaticShotWasCut) {
    Relay relay(10);
    relay.show(match_info("cup", {{1, "", "", 0}, {2, "", "", 0}}));
    const auto watcher = viewer();
    ASSERT_EQ(relay.join("cup", watcher), Relay::Admission::joined);
    const auto show = [&](std::uint32_t number, std::uint32_t target, std::uint32_t pose_flags) {
        director::CameraFrame cameras = cameras_of(poses_of({1, 2}, number, pose_flags), target, 1 | 2);
        cameras.reasons = {{cameras.cameras.at(0).camera_id, {1, 2, "duel"}}};
        relay.show("cup", poses_of({1, 2}, number, pose_flags), cameras);
    };
    show(1, 1, 1);                    // begins
    show(2, 2, 1);                    // another player
    show(3, 2, 3);                    // respawned: told again, but not why it cuts
    show(4, director::no_player, 1);  // a fixed camera, then another one
    show(5, director::no_player, 1);
    std::vector<json> moments;
    for (const json& note : take_all(*watcher))
        if (note.is_object() && note["kind"] == "cut") moments.push_back(note.value("moment", json()));
    const json duel = {{"rule", "duel"}, {"actor", 0}, {"subject", 1}};
    EXPECT_EQ(moments, (std::vector<json>{duel, duel, json(), duel, duel}));
}

TEST(Relay, KeepsThePlayersSlots) {
    Relay relay(10);
    relay.show(match_info("cup", {{7, "Ann", "", 0}, {8, "Bob", "", 0}}));
    const auto watcher = viewer();
    ASSERT_EQ(relay.join("cup", watcher), Relay::Admission::joined);
    const auto poses = poses_of({8, 9}, 1);  // 9 is not listed
    relay.show("cup", poses, cameras_of(poses, 8, 2));
    relay.show(match_info("cup", {{8, "Bob", "", 0}, {9, "Cem", "", 0}}));
    json last;
    for (const json& message : take_all(*watcher))
        if (message.is_object() && message["kind"] == "match") last = message["players"];
    ASSERT_EQ(last.size(), 3U);
    EXPECT_EQ(last[0], json::parse(R"({"slot":0,"id":7,"listed":false})"));
    EXPECT_EQ(last[1]["name"], "Bob");
    EXPECT_EQ(last[2]["slot"], 2);
    EXPECT_EQ(last[2]["name"], "Cem");
}

TEST(Relay, GivesSlotsOfThoseWhoHaveGoneAwayWhenAllAreTaken) {
    Relay relay(10);
    for (std::uint32_t player = 0; player < 600; ++player)
        relay.show(match_info("cup", {{player, "", "", 0}}));
    const auto watcher = viewer();
    ASSERT_EQ(relay.join("cup", watcher), Relay::Admission::joined);
    const json players = take_all(*watcher).front()["players"];
    EXPECT_EQ(players.size(), 255U);
    EXPECT_EQ(
        std::count_if(players.begin(), players.end(),
                      [](const json& player) { return player["listed"] == true && player["id"] == 599; }),
        1);
}

// All slots are taken by those of `first` and on.
std::vector<director::Player> crowd(std::uint32_t first, std::uint32_t count = 255) {
    std::vector<director::Player> players;
    for (std::uint32_t player = first; player < first + count; ++player)
        players.push_back({player, "", "", 0});
    return players;
}

json last_players(Viewer& watcher) {
    json last;
    for (const json& message : take_all(watcher))
        if (message.is_object() && message["kind"] == "match") last = message["players"];
    return last;
}

TEST(Relay, WhoIsStillListedKeepsTheirSlotThoughANewPlayerIsListedBefore) {
    Relay relay(10);
    auto players = crowd(1000);
    relay.show(match_info("cup", players));
    const auto watcher = viewer();
    ASSERT_EQ(relay.join("cup", watcher), Relay::Admission::joined);
    const json before = last_players(*watcher);
    players.pop_back();  // of whose slot the new one is
    players.insert(players.begin(), {7, "new", "", 0});
    relay.show(match_info("cup", players));
    const json after = last_players(*watcher);
    ASSERT_EQ(after.size(), 255U);
    for (std::size_t slot = 0; slot < 254; ++slot)
        EXPECT_EQ(after[slot]["id"], before[slot]["id"]);
    EXPECT_EQ(after[254]["id"], 7);
}

TEST(Relay, TellsWhoHasTheSlotOfAnotherNow) {
    Relay relay(10);
    relay.show(match_info("cup", crowd(1000)));
    relay.show(match_info("cup", crowd(1000, 254)));
    const auto watcher = viewer();
    ASSERT_EQ(relay.join("cup", watcher), Relay::Admission::joined);
    const auto poses = poses_of({7}, 1);  // is not listed
    relay.show("cup", poses, cameras_of(poses, 7, 2));
    const json players = last_players(*watcher);
    ASSERT_EQ(players.size(), 255U);
    EXPECT_EQ(players[254]["id"], 7);
}

TEST(Relay, ForgetsTheHistoryOfAnotherMap) {
    Relay relay(10);
    director::MatchInfo info = match_info("cup", {{7, "Ann", "", 0}});
    relay.show(info);
    const auto poses = poses_of({7}, 1);
    relay.show("cup", poses, cameras_of(poses, 7, 2));
    info.map_name = "yard";
    relay.show(info);
    const auto watcher = viewer();
    ASSERT_EQ(relay.join("cup", watcher), Relay::Admission::joined);
    EXPECT_EQ(take_all(*watcher).size(), 2U) << "match and an empty history, no frame";
}

TEST(Relay, ForgetsTheHistoryOfAnEpochThatIsOver) {
    Relay relay(10);
    relay.show(match_info("cup", {{1, "", "", 0}}));
    const auto poses = poses_of({1}, 1);
    relay.show("cup", poses, cameras_of(poses, 1, 3));
    relay.show(match_info("cup", {{1, "", "", 0}}, 2));
    const auto late = viewer();
    ASSERT_EQ(relay.join("cup", late), Relay::Admission::joined);
    const auto told = take_all(*late);
    ASSERT_EQ(told.size(), 2U) << "no frame";
    EXPECT_TRUE(told[1]["states"].empty());
    EXPECT_TRUE(told[1]["notes"].empty());
}

TEST(Relay, BoundsHistory) {
    Relay relay(10);
    relay.show(match_info("cup", {{1, "", "", 0}}));
    for (std::uint32_t number = 1; number < 5000; ++number) {
        const auto poses = poses_of({1}, number);
        relay.show("cup", poses, cameras_of(poses, 1, 1 | (number % 2) << 1));
        relay.show("cup", event_of(number, 1));
    }
    const auto late = viewer();
    ASSERT_EQ(relay.join("cup", late), Relay::Admission::joined);
    const auto told = take_all(*late);
    EXPECT_EQ(told[1]["states"].size(), History::max_states);
    EXPECT_EQ(told[1]["notes"].size(), History::max_cuts + History::max_events);
}

TEST(Relay, ManyWoundsPushNoCutOrKillOutOfTheHistory) {
    constexpr std::uint32_t kill = 1;
    constexpr std::uint32_t damage = 5;
    Relay relay(10);
    relay.show(match_info("cup", {{1, "", "", 0}}));
    const auto poses = poses_of({1}, 1);
    relay.show("cup", poses, cameras_of(poses, 1, 1));
    relay.show("cup", event_of(1, kill));
    const auto there = viewer();
    ASSERT_EQ(relay.join("cup", there), Relay::Admission::joined);
    take_all(*there);
    relay.show("cup", event_of(2, damage));
    EXPECT_EQ(take_all(*there).size(), 1U) << "who is there is told of wounds";
    there->leave();
    for (std::uint32_t number = 3; number < 5000; ++number)
        relay.show("cup", event_of(number, damage));
    const auto late = viewer();
    ASSERT_EQ(relay.join("cup", late), Relay::Admission::joined);
    const auto notes = take_all(*late)[1]["notes"];
    ASSERT_EQ(notes.size(), 2U);
    EXPECT_EQ(notes[0]["kind"], "cut");
    EXPECT_EQ(notes[1]["event"], "kill");
}

TEST(Relay, LetsInSoManyViewersAndNoMore) {
    Relay relay(2);
    relay.show(match_info("cup", {}));
    const auto a = viewer();
    const auto b = viewer();
    const auto c = viewer();
    EXPECT_EQ(relay.join("nothing", a), Relay::Admission::no_match);
    EXPECT_EQ(relay.join("cup", a), Relay::Admission::joined);
    EXPECT_EQ(relay.join("cup", b), Relay::Admission::joined);
    EXPECT_EQ(relay.join("cup", c), Relay::Admission::full);
    a->leave();
    EXPECT_EQ(relay.join("cup", c), Relay::Admission::joined);
    EXPECT_EQ(relay.statistics().viewers, 2U);
}

TEST(Relay, CountsWhatSlowViewersLose) {
    Relay relay(10);
    relay.show(match_info("cup", {{1, "", "", 0}}));
    const auto slow = std::make_shared<Viewer>([] {}, ViewerLimits{4, 10});
    ASSERT_EQ(relay.join("cup", slow), Relay::Admission::joined);
    for (std::uint32_t number = 1; number <= 10; ++number)
        relay.show("cup", poses_of({1}, number), {});
    EXPECT_EQ(relay.statistics().frames, 10U);
    EXPECT_EQ(relay.statistics().dropped_frames, 6U);
    for (std::uint32_t number = 0; number < 20; ++number)
        relay.show("cup", director::MatchEvent{});
    EXPECT_EQ(relay.statistics().viewers, 0U);
    EXPECT_EQ(relay.statistics().lost_viewers, 1U);
}

TEST(Relay, EndsWithTheMatch) {
    Relay relay(10);
    relay.show(match_info("cup", {}));
    const auto watcher = viewer();
    ASSERT_EQ(relay.join("cup", watcher), Relay::Admission::joined);
    relay.end("cup");
    EXPECT_EQ(take_all(*watcher).back(), json::parse(R"({"kind":"end","reason":"match"})"));
    EXPECT_TRUE(watcher->finished());
    EXPECT_EQ(relay.join("cup", viewer()), Relay::Admission::no_match);
}

// A viewer who has joined is told of the end, however the match's thread and theirs meet.
TEST(Relay, TellsViewersThatTheServerStopsAndWaitsUntilTheyHaveLeft) {
    using namespace std::chrono_literals;
    Relay relay(10);
    relay.show(match_info("cup", {}));
    const auto leaves = viewer();
    const auto stays = viewer();
    for (const auto& one : {leaves, stays})
        ASSERT_EQ(relay.join("cup", one), Relay::Admission::joined);
    std::thread connection([&] {
        while (!leaves->finished())
            (void)leaves->take();
        leaves->leave();
    });
    EXPECT_EQ(relay.close(50ms), 1U) << "one takes nothing";
    connection.join();
    EXPECT_EQ(take_all(*stays).back(), json::parse(R"({"kind":"end","reason":"server"})"));
    relay.show(match_info("cup", {}));
    relay.show(match_info("late", {}));
    EXPECT_EQ(relay.join("late", viewer()), Relay::Admission::no_match);
    EXPECT_EQ(relay.close(10s), 0U) << "nobody is left to wait for";
}

TEST(Relay, ViewersWhoJoinWhileTheMatchEndsAreNotLeftWaiting) {
    Relay relay(1'000'000);
    std::atomic<bool> stop{false};
    std::thread match([&] {
        while (!stop) {
            relay.show(match_info("cup", {}));
            relay.end("cup");
        }
    });
    std::vector<std::shared_ptr<Viewer>> joined;
    for (int i = 0; i < 20'000; ++i) {
        const auto late = viewer();
        if (relay.join("cup", late) == Relay::Admission::joined) joined.push_back(late);
    }
    stop = true;
    match.join();
    for (const auto& late : joined) {
        const auto told = take_all(*late);
        ASSERT_FALSE(told.empty());
        EXPECT_EQ(told.back()["kind"], "end");
        EXPECT_TRUE(late->finished());
    }
}

}  // namespace
}  // namespace camdir::live
