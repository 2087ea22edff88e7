#include "evaluation/kills.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string_view>

#include "box_scene.hpp"
#include "support/shared_files.hpp"
#include "tiny_trace.hpp"

namespace camdir::evaluation {
namespace {

constexpr double degrees = 180.0 / std::numbers::pi;

Trace players_4_and_9() {
    Trace trace;
    trace.players = {4, 9};
    add_frame(trace, 0, {standing(4, {0, 0, 100}), standing(9, {0, 0, 100})});
    add_frame(trace, 9000, {standing(4, {0, 0, 100}), standing(9, {0, 0, 100})});
    return trace;
}

Result<std::vector<Kill>> kills_in(std::string_view text) {
    return parse_kills(std::as_bytes(std::span(text)), "events.csv", players_4_and_9());
}

TEST(Kills, AreReadFromBothKindsOfTables) {
    for (const char* text : {"t_ms,event,player,other,detail\n"
                             "100,respawn,9,,\n"
                             "1256.5,kill,4,9,MOD_ROCKET\n"
                             "3000,kill,9,4,MOD_SHOTGUN\n",
                             "t_ms,kind,actor,subject,value\r\n"
                             "100,item,9,,rl\r\n"
                             "1256.5,kill,4,9,rl\r\n"
                             "3000,kill,9,4,sg"}) {
        const auto kills = kills_in(text);
        ASSERT_TRUE(kills) << kills.error().message;
        ASSERT_EQ(kills->size(), 2U);
        EXPECT_EQ((*kills)[0].time, 1'256'500'000);
        EXPECT_EQ((*kills)[0].killer, 4U);
        EXPECT_EQ((*kills)[0].victim, 9U);
        EXPECT_EQ((*kills)[1].killer, 9U);
    }
}

TEST(Kills, OfNobodyAndOfOneselfAreLeftOut) {
    const auto kills =
        kills_in("t_ms,event,player,other\n1,kill,,4\n2,kill,4,\n3,kill,,\n4,kill,9,9\n5,kill,1022,4\n");
    ASSERT_TRUE(kills) << kills.error().message;
    EXPECT_TRUE(kills->empty());
}

TEST(Kills, AreTheMatchsOwnWhereNoFileIsNamed) {
    RecordedMatch match;
    match.trace.players = {0, 1};
    EXPECT_FALSE(kills_of(match, "").value());
    match.events = {{1, "kill", 0, 1, "rl"},
                    {2, "death", {}, 1, "fall"},
                    {3, "kill", 1, 1, "rl"},
                    {4, "kill", {}, 1, "rl"},
                    {5, "damage", 0, 1, "9"}};
    const auto kills = kills_of(match, "").value();
    ASSERT_TRUE(kills);
    ASSERT_EQ(kills->size(), 1U);
    EXPECT_EQ(kills->front().time, 1);
    EXPECT_EQ(kills->front().killer, 0U);
    EXPECT_EQ(kills->front().victim, 1U);
    EXPECT_FALSE(kills_of(match, "missing.csv"));
}

TEST(Kills, ErrorsNameTheLineAndTheReason) {
    const auto error_of = [](const std::string& text) {
        const auto kills = kills_in(text);
        return kills ? "no error" : kills.error().message;
    };
    const std::string header = "t_ms,event,player,other\n";
    const std::string first = header + "1,kill,4,9\n";
    EXPECT_EQ(error_of(""), "events.csv: empty, expected a header line");
    EXPECT_EQ(error_of("t_ms,event,player\n"),
              "events.csv:1: the header lacks the column \"other\"; found \"t_ms,event,player\"");
    EXPECT_EQ(error_of("t_ms,event,kind,player,other\n"),
              "events.csv:1: the header has the column \"event\" or \"kind\" more than once; found "
              "\"t_ms,event,kind,player,other\"");
    EXPECT_EQ(error_of(first + "2,kill,4\n"), "events.csv:3: 3 fields, expected 4 as in the header");
    EXPECT_EQ(error_of(first + "2,kill,4,5\n"),
              "events.csv:3: column \"other\" is 5, expected a player of the trace");
    EXPECT_EQ(error_of(first + "2,kill,-1,4\n"),
              "events.csv:3: column \"player\" is \"-1\", expected an integer from 0 to 4294967294");
    EXPECT_EQ(error_of(first + "2,kill,4,9.5\n"),
              "events.csv:3: column \"other\" is \"9.5\", expected an integer from 0 to 4294967294");
    for (const char* time : {"nan", "inf", "-1", "1e13", "", "x\x01"})
        EXPECT_THAT(error_of(first + time + ",respawn,4,\n"),
                    testing::StartsWith("events.csv:3: column \"t_ms\" is "))
            << time;
    EXPECT_THAT(error_of(first + std::string(5000, 'x')), testing::StartsWith("events.csv:3: "));
}

// Player 0 stands at the origin of the room and player 1 in front of them, with frames each 50 ms. The kill
// is at 1 s: the frames from 750 ms on count.
struct Duel {
    Trace trace;
    CameraPath cameras;

    Duel() {
        trace.players = {0, 1};
        for (std::int64_t t = 0; t <= 2000; t += 50) {
            add_frame(trace, t, {standing(0, {0, 0, 100}), standing(1, {200, 0, 100})});
            cameras.resize(trace.poses.size(), {Vec3d(-120, 0, 100), Eigen::Quaterniond::Identity(), false});
        }
    }
    CameraSample& camera_at(std::int64_t milliseconds) {
        return cameras[static_cast<std::size_t>(milliseconds / 50 * 2)];
    }
    TracePose& victim_at(std::int64_t milliseconds) {
        return trace.poses[static_cast<std::size_t>(milliseconds / 50 * 2 + 1)];
    }
    [[nodiscard]] double judged(const scene::Scene& scene, std::int64_t milliseconds = 1000) const {
        const Kill kill{milliseconds * 1'000'000, 0, 1};
        return kill_in_view(oracle::Oracle(scene), scene.metres_per_unit, trace, cameras,
                            std::span(&kill, 1));
    }
};

TEST(KillInView, CountsTheQuarterSecondUpToTheKill) {
    const CameraSample away{Vec3d(-120, 0, 100), quake_orientation(0, 180, 0), false};
    for (std::int64_t t = 600; t <= 1150; t += 50) {
        Duel duel;
        duel.camera_at(t) = away;
        EXPECT_EQ(duel.judged(room()), t >= 750 && t <= 1000 ? 0.0 : 100.0) << t;
    }
}

TEST(KillInView, CountsTheWholePicture) {
    const auto judged = [](double pitch, double yaw) {
        Duel duel;
        for (CameraSample& camera : duel.cameras)
            camera.orientation = quake_orientation(pitch, yaw, 0);
        return duel.judged(room());
    };
    EXPECT_EQ(judged(0, 44.9), 100.0);
    EXPECT_EQ(judged(0, 45.1), 0.0);
    // Looking down the eye leaves the picture at its upper edge last: it is above the box's centre.
    const double half_height = std::atan(9.0 / 16.0) * degrees;
    const double centre = std::atan(22.0 / 320.0) * degrees;  // 22 units below the eye
    EXPECT_EQ(judged(half_height - 0.1, 0), 100.0);
    EXPECT_EQ(judged(half_height + centre - 0.1, 0), 100.0);
    EXPECT_EQ(judged(half_height + centre + 0.1, 0), 0.0);
    EXPECT_EQ(judged(-half_height + 0.1, 0), 100.0);
    EXPECT_EQ(judged(-half_height - 0.1, 0), 0.0);
}

// The box's centre is at z = 78, the eye at 100; a ray to the centre from z = 100 crosses x = 100 at 84.9.
TEST(KillInView, EyeOrCentreIsEnough) {
    scene::Scene low = room();
    add_box(low, {99, -200, 0}, {101, 200, 90});
    EXPECT_EQ(Duel().judged(low), 100.0) << "the eye";
    scene::Scene high = room();
    add_box(high, {99, -200, 95}, {101, 200, 300});
    EXPECT_EQ(Duel().judged(high), 100.0) << "the centre";
    scene::Scene both = high;
    add_box(both, {99, -200, 0}, {101, 200, 90});
    EXPECT_EQ(Duel().judged(both), 0.0);
}

TEST(KillInView, NeedsTheFramesOfBoth) {
    Duel duel;
    EXPECT_TRUE(std::isnan(duel.judged(room(), 200))) << "begins before the trace";
    EXPECT_EQ(duel.judged(room(), 250), 100.0);
    EXPECT_EQ(duel.judged(room(), 2000), 100.0);
    EXPECT_TRUE(std::isnan(duel.judged(room(), 2001))) << "ends after the trace";
    duel.victim_at(900).player = 2;
    EXPECT_TRUE(std::isnan(duel.judged(room())));
    EXPECT_EQ(duel.judged(room(), 1200), 100.0);
}

TEST(KillInView, IsTheShareOfAllKills) {
    Duel duel;
    duel.camera_at(500).orientation = quake_orientation(0, 180, 0);
    const std::vector<Kill> kills{
        {500'000'000, 0, 1}, {1'000'000'000, 0, 1}, {1'500'000'000, 0, 1}, {1'500'000'000, 1, 0}};
    const scene::Scene scene = room();
    const oracle::Oracle oracle(scene);
    // The camera of player 1 stands where that of player 0 does.
    EXPECT_EQ(kill_in_view(oracle, scene.metres_per_unit, duel.trace, duel.cameras, kills), 75.0);
    EXPECT_TRUE(std::isnan(kill_in_view(oracle, scene.metres_per_unit, duel.trace, duel.cameras, {})));
}

TEST(Kills, OfRecordedMatches) {
    const struct {
        const char* trace;
        const char* events;
        std::size_t kills;
    } matches[] = {{"traces/oa_dm1-60hz.csv.gz", "traces/oa_dm1-60hz.events.csv", 96},
                   {"traces/oa_dm3-60hz.csv.gz", "traces/oa_dm3-60hz.events.csv", 58},
                   {"traces/human/dm2-4on4-20hz.csv.gz", "traces/human/dm2-4on4-events.csv.gz", 76}};
    for (const auto& match : matches) {
        const auto trace_file = test::shared_file(match.trace);
        const auto events_file = test::shared_file(match.events);
        if (!trace_file || !events_file) GTEST_SKIP() << test::needs_shared_file(match.events);
        const auto kills = read_kills(*events_file, read_trace(*trace_file).value());
        ASSERT_TRUE(kills) << kills.error().message;
        EXPECT_EQ(kills->size(), match.kills) << match.events;
    }
}

}  // namespace
}  // namespace camdir::evaluation
