#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <set>

#include "evaluation/match.hpp"
#include "evaluation/resample.hpp"
#include "gzip.hpp"
#include "support/demo_writer.hpp"
#include "support/shared_files.hpp"

namespace camdir::evaluation {
namespace {

using camdir::test::DemoMessages;
using camdir::test::DemoWriter;
using testing::ElementsAre;
using testing::HasSubstr;
using Pose = DemoMessages::Pose;

// A level with two players, slots 2 and 5, and a spectator, slot 3.
DemoWriter begun(std::string_view server_info = R"(\teamplay\2\mode\2on2)",
                 std::initializer_list<std::pair<std::uint32_t, std::uint32_t>> extensions = {}) {
    DemoWriter demo;
    demo.to_everyone(0, DemoMessages()
                            .begin_level(extensions)
                            .client_command("fullserverinfo \"" + std::string(server_info) + "\"\n")
                            .models({"progs/player.mdl", "progs/eyes.mdl", "maps/a.bsp"})
                            .user_info(2, R"(\name\anna\team\red)")
                            .user_info(3, R"(\name\carl\*spectator\1)")
                            .user_info(5, R"(\name\bert\team\blue)"));
    return demo;
}

Pose at(const Vec3d& origin, const Vec3d& angles = Vec3d::Zero()) {
    return {.origin = origin, .angles = angles};
}

// A frame of both players.
DemoWriter& frame(DemoWriter& demo, int after, const Pose& anna, const Pose& bert,
                  DemoMessages more = DemoMessages()) {
    return demo.to_everyone(after, more.player(2, anna).player(5, bert));
}

RecordedMatch read(const DemoWriter& demo) {
    auto match = parse_match(demo.bytes(), "match.mvd");
    EXPECT_TRUE(match) << match.error().message;
    EXPECT_EQ(match->warning, "");
    return match ? std::move(*match) : RecordedMatch{};
}

std::string error_of(const Bytes& bytes) {
    const auto match = parse_match(bytes, "match.mvd");
    return match ? "no error" : match.error().message;
}

std::vector<std::string> events_of(const RecordedMatch& match) {
    std::vector<std::string> rows;
    const auto name = [](const std::optional<std::uint32_t>& player) {
        return player ? std::to_string(*player) : "";
    };
    for (const TraceEvent& event : *match.events)
        rows.push_back(std::to_string(event.time / 1'000'000) + "," + event.kind + "," + name(event.actor) +
                       "," + name(event.subject) + "," + event.detail);
    return rows;
}

TEST(Demo, PlayersHaveTheirPosesInEveryFrame) {
    DemoWriter demo = begun();
    frame(demo, 10, at({8, 16, -24.5}, {45, 90, 0}), at({100, 0, 0}));
    demo.sequences(3);
    frame(demo, 10, at({9, 16, -24.5}, {45, 90, 0}), at({100, 0, 0}));
    const RecordedMatch match = read(demo);
    EXPECT_THAT(match.trace.players, ElementsAre(0, 1));
    ASSERT_EQ(match.trace.frames.size(), 2U);
    EXPECT_EQ(match.trace.frames[0].time, 10'000'000);
    EXPECT_EQ(match.trace.frames[1].time, 23'000'000) << "blocks without messages take time too";
    ASSERT_EQ(match.trace.poses.size(), 4U);
    const TracePose& pose = match.trace.poses[0];
    EXPECT_EQ(pose.player, 0U);
    EXPECT_EQ(pose.eye, Vec3d(8, 16, -2.5));
    EXPECT_EQ(pose.origin(), Vec3d(8, 16, -24.5));
    EXPECT_LT(pose.orientation.angularDistance(quake_orientation(45, 90, 0)), 1e-6);
    EXPECT_EQ(pose.team, 1);
    EXPECT_EQ(match.trace.poses[1].team, 2);
    EXPECT_TRUE(pose.alive && pose.discontinuity);
    EXPECT_FALSE(match.trace.poses[2].discontinuity);
    EXPECT_NEAR(match.trace.poses[2].velocity.x(), 1000.0 / 13.0, 1e-9);
}

TEST(Demo, WithoutTeamplayEveryoneIsAnEnemy) {
    DemoWriter demo = begun(R"(\teamplay\0)");
    frame(demo, 10, at({0, 0, 0}), at({100, 0, 0}));
    EXPECT_EQ(read(demo).trace.poses[1].team, 0);
}

TEST(Demo, WhatDoesNotChangeStays) {
    DemoWriter demo = begun();
    frame(demo, 10, at({8, 16, 24}), at({100, 0, 0}));
    demo.to_everyone(10, DemoMessages().player_moved(2, 1, 20));
    const RecordedMatch match = read(demo);
    ASSERT_EQ(match.trace.frames[1].pose_count, 1U) << "bert is missing from this frame";
    EXPECT_EQ(match.trace.poses[2].origin(), Vec3d(8, 20, 24));
}

TEST(Demo, SpectatorsAreLeftOut) {
    DemoWriter demo = begun();
    frame(demo, 10, at({8, 16, 24}), at({100, 0, 0}), DemoMessages().player(3, at({0, 0, 0})));
    demo.to_everyone(
        10,
        DemoMessages().user_key(5, "*spectator", "1").player(2, at({8, 16, 24})).player(5, at({0, 0, 0})));
    const RecordedMatch match = read(demo);
    EXPECT_THAT(match.trace.players, ElementsAre(0, 1));
    EXPECT_EQ(match.trace.frames[0].pose_count, 2U);
    EXPECT_EQ(match.trace.frames[1].pose_count, 1U);
}

TEST(Demo, TheDeadSeeFromBelowAndRespawn) {
    DemoWriter demo = begun();
    const Pose bert = at({100, 0, 0});
    frame(demo, 10, at({0, 0, 0}), bert);
    frame(demo, 10, {.dead = true}, bert);
    frame(demo, 10, {.dead = true, .gibbed = true}, bert);
    frame(demo, 10, {.model = 3}, bert);
    frame(demo, 10, {.model = 2}, bert);
    const RecordedMatch match = read(demo);
    const auto of_anna = [&](std::size_t i) { return match.trace.poses[2 * i]; };
    EXPECT_EQ(of_anna(1).view_height, -16.0F);
    EXPECT_EQ(of_anna(2).view_height, 8.0F);
    EXPECT_FALSE(of_anna(1).alive || of_anna(2).alive || of_anna(3).alive) << "the last one has no body";
    EXPECT_TRUE(of_anna(4).alive) << "invisible, but for the eyes";
    EXPECT_TRUE(of_anna(4).discontinuity);
    EXPECT_FALSE(of_anna(2).discontinuity);
}

TEST(Demo, DisplacedPlayersJump) {
    const auto jumps = [](const Vec3d& to, std::optional<Vec3d> flash) {
        DemoWriter demo = begun();
        frame(demo, 10, at({0, 0, 0}), at({100, 0, 0}));
        DemoMessages more;
        if (flash) demo.to_some(20, 4, DemoMessages().teleport_flash(*flash));
        frame(demo, flash ? 0 : 20, at(to), at({100, 0, 0}), more);
        return read(demo).trace.poses[2].discontinuity;
    };
    EXPECT_FALSE(jumps({47, 0, 0}, std::nullopt));
    EXPECT_TRUE(jumps({49, 0, 0}, std::nullopt)) << "faster than 2,000 units/s and 8 units";
    EXPECT_FALSE(jumps({47, 0, 0}, Vec3d(60, 0, 0))) << "may have run";
    DemoWriter demo = begun();
    frame(demo, 10, at({0, 0, 0}), at({100, 0, 0}));
    demo.to_some(40, 4, DemoMessages().teleport_flash({90, 0, 0}));
    frame(demo, 0, at({70, 0, 0}), at({130, 70, 0}));
    const RecordedMatch match = read(demo);
    EXPECT_TRUE(match.trace.poses[2].discontinuity) << "beside the flash";
    EXPECT_TRUE(match.trace.poses[3].discontinuity);
}

TEST(Demo, AFlashInAnotherFrameIsNoTeleport) {
    DemoWriter demo = begun();
    demo.to_some(5, 4, DemoMessages().teleport_flash({70, 0, 0}));
    frame(demo, 10, at({0, 0, 0}), at({100, 0, 0}));
    frame(demo, 40, at({70, 0, 0}), at({100, 0, 0}));
    EXPECT_FALSE(read(demo).trace.poses[2].discontinuity);
}

TEST(Demo, AViewThatTheServerTurnsLateHoldsFromTheRespawnOn) {
    DemoWriter demo = begun();
    const Pose bert = at({100, 0, 0});
    frame(demo, 10, at({0, 0, 0}), bert);
    frame(demo, 10, at({500, 0, 0}, {0, 0, 0}), bert);
    frame(demo, 10, at({500, 0, 0}, {0, 90, 0}), bert);
    frame(demo, 10, at({500, 0, 0}, {0, 0, 0}), bert);
    frame(demo, 10, at({500, 0, 0}, {0, 90, 0}), bert);
    frame(demo, 10, at({500, 0, 0}, {0, 99, 0}), bert);
    const RecordedMatch match = read(demo);
    std::vector<int> yaws;
    for (std::size_t i = 0; i < match.trace.poses.size(); i += 2) {
        const Vec3d forward = match.trace.poses[i].orientation * Vec3d::UnitX();
        yaws.push_back(static_cast<int>(
            std::lround(std::atan2(forward.y(), forward.x()) / radians_of_a_degree<double>)));
    }
    EXPECT_THAT(yaws, ElementsAre(0, 90, 90, 90, 90, 99));
}

TEST(Demo, TheMatchIsWhatIsRead) {
    DemoWriter demo = begun();
    frame(demo, 10, at({0, 0, 0}), at({100, 0, 0}), DemoMessages().print(1, "anna rides bert's rocket\n"));
    demo.to_everyone(10, DemoMessages().print(2, "The \xed\xe1\xf4\xe3\xe8 has begun!\n"));
    frame(demo, 0, at({1, 0, 0}), at({100, 0, 0}));
    frame(demo, 10, at({2, 0, 0}), at({100, 0, 0}), DemoMessages().print(1, "bert rides anna's rocket\n"));
    demo.to_everyone(10, DemoMessages().intermission());
    frame(demo, 0, at({3, 0, 0}), at({100, 0, 0}));
    const RecordedMatch match = read(demo);
    ASSERT_EQ(match.trace.frames.size(), 2U);
    EXPECT_EQ(match.trace.frames[0].time, 20'000'000);
    EXPECT_EQ(match.trace.poses[0].origin().x(), 1.0);
    EXPECT_TRUE(match.trace.poses[0].discontinuity);
    EXPECT_THAT(events_of(match), ElementsAre("30,kill,0,1,rl"));
}

TEST(Demo, ServersAnnounceTheBeginAndTheEndInSeveralWays) {
    const auto frames = [](const DemoMessages& begin, const DemoMessages& end) {
        DemoWriter demo = begun();
        frame(demo, 10, at({0, 0, 0}), at({100, 0, 0}));
        demo.to_everyone(10, begin);
        frame(demo, 0, at({0, 0, 0}), at({100, 0, 0}));
        demo.to_everyone(10, end);
        frame(demo, 0, at({0, 0, 0}), at({100, 0, 0}));
        return read(demo).trace.frames.size();
    };
    const auto message = [] { return DemoMessages(); };
    EXPECT_EQ(
        frames(message().client_command("//ktx matchstart\n"), message().print(2, "The match is over\n")),
        1U);
    EXPECT_EQ(
        frames(message().server_key("status", "10 min left"), message().server_key("status", "Standby")), 1U);
    EXPECT_EQ(frames(message(), message().server_key("status", "Standby")), 3U) << "no match: the whole demo";
}

TEST(Demo, ObituariesAreKillsAndDeaths) {
    DemoWriter demo = begun();
    frame(demo, 10, at({0, 0, 0}), at({100, 0, 0}),
          DemoMessages()
              .print(1, "anna was gibbed by bert's grenade\n")
              .print(1, "bert ate 2 loads of anna's buckshot\n")
              .print(1, "anna rips bert a new one\n")
              .print(1, "bert fell to his death\n")
              .print(1, "anna discharges into the lava\n")
              .print(1, "dora rides anna's rocket\n")
              .print(1, "anna rides bert's rocket, they say\n")
              .print(3, "anna rides bert's rocket\n"));
    EXPECT_THAT(events_of(read(demo)), ElementsAre("10,kill,1,0,gl", "10,kill,0,1,ssg", "10,kill,0,1,rl",
                                                   "10,death,,1,fall", "10,death,,0,self"));
}

TEST(Demo, ObituariesInPiecesAndColoursAreRead) {
    DemoWriter demo = begun();
    frame(demo, 10, at({0, 0, 0}), at({100, 0, 0}),
          DemoMessages()
              .user_key(2, "name", "\xe1nn\x12")
              .print(1, "\xe1nn\x12")
              .print(1, " was nailed by ")
              .print(1, "bert")
              .print(1, "\n"));
    EXPECT_THAT(events_of(read(demo)), ElementsAre("10,kill,1,0,ng"));
}

TEST(Demo, NamesMayBePartsOfNames) {
    DemoWriter demo = begun();
    frame(demo, 10, at({0, 0, 0}), at({100, 0, 0}),
          DemoMessages()
              .user_key(2, "name", "a")
              .user_key(5, "name", "a was nailed by a")
              .print(1, "a was nailed by a was nailed by a\n"));
    EXPECT_THAT(events_of(read(demo)), ElementsAre(testing::AnyOf("10,kill,1,0,ng", "10,kill,0,1,ng")));
}

// Of a team mate's death the server names only one of the two.
TEST(Demo, TheOtherOneOfATeamKillIsFound) {
    DemoWriter demo = begun();
    const auto third = DemoMessages().user_info(7, R"(\name\dora\team\red)");
    frame(demo, 10, at({0, 0, 0}), at({100, 0, 0}), DemoMessages(third).player(7, at({40, 0, 0})));
    frame(demo, 10, at({0, 0, 0}), at({100, 0, 0}),
          DemoMessages()
              .print(1, "anna loses another friend\n")
              .player(7, {.origin = {40, 0, 0}, .dead = true}));
    frame(demo, 10, at({0, 0, 0}), at({100, 0, 0}), DemoMessages().player(7, at({40, 0, 0})));
    frame(demo, 200, at({40, 0, 0}), at({100, 0, 0}),
          DemoMessages()
              .print(1, "dora was telefragged by her teammate\n")
              .player(7, {.origin = {40, 0, 0}, .dead = true}));
    EXPECT_THAT(events_of(read(demo)), ElementsAre("20,kill,0,2,team", "230,kill,0,2,team"));
}

TEST(Demo, DamageIsInBlocksThatAreHiddenFromClients) {
    DemoWriter demo = begun();
    frame(demo, 10, at({0, 0, 0}), at({100, 0, 0}));
    demo.hidden(0, DemoMessages()
                       .hidden_section(3, DemoMessages().zeros(5))
                       .hidden_damage(3, 6, 110)
                       .hidden_damage(0, 3, 5)
                       .hidden_damage(3, 200, 50)
                       .hidden_damage(3, 1, 50)
                       .hidden_section(7, DemoMessages().zeros(7))
                       .number(1000, 4)
                       .number(7, 2));
    EXPECT_THAT(events_of(read(demo)), ElementsAre("10,damage,0,1,110", "10,damage,,0,5"))
        << "a door's, that of a player who is not in the trace and what is cut off are left out";
}

TEST(Demo, ItemsAreWhatTheStatsGain) {
    constexpr int rockets = 1 << 5;
    constexpr int red = 1 << 15;
    constexpr int mega = 1 << 16;
    constexpr int quad = 1 << 22;
    const auto demo_on = [](std::string_view mode) {
        DemoWriter demo = begun(mode);
        const auto later = [&](const DemoMessages& stats) {
            frame(demo, 10, at({0, 0, 0}), at({100, 0, 0}));
            demo.stats(0, 5, stats);
        };
        later(DemoMessages().stat(0, 100).long_stat(15, rockets));
        later(DemoMessages().long_stat(15, rockets | red).stat(4, 200));
        later(DemoMessages().stat(4, 120));
        later(DemoMessages().stat(4, 200));
        later(DemoMessages().stat(0, 200).long_stat(15, rockets | red | mega | quad));
        later(DemoMessages().long_stat(0, -10).long_stat(15, 0));
        later(DemoMessages().stat(0, 100).long_stat(15, rockets));
        return demo;
    };
    EXPECT_THAT(events_of(read(demo_on(R"(\mode\ffa)"))),
                ElementsAre("20,item,1,,ra", "40,item,1,,ra", "50,item,1,,mh", "50,item,1,,quad"));
    EXPECT_THAT(events_of(read(demo_on(R"(\mode\wipeout)"))), ElementsAre());
}

TEST(Demo, CoordinatesMayBeWide) {
    for (const auto& extension : {std::pair{test::fte, 0x8000U}, std::pair{test::mvd_1, 1U}}) {
        DemoWriter demo = begun("", {{test::fte_2, 1U}, extension});
        demo.to_everyone(
            10, DemoMessages(true).player(2, at({10000.25, 2, 3})).player(5, at({0, 0, 0})).intermission());
        EXPECT_EQ(read(demo).trace.poses[0].origin(), Vec3d(10000.25, 2, 3));
    }
}

// Every message that is only skipped, by the bytes that follow its number.
TEST(Demo, MessagesAreSkippedByTheirSizes) {
    struct Skipped {
        int number;
        DemoMessages content;
    };
    const auto fields = [] { return DemoMessages(); };
    const Skipped skipped[] = {
        {1, fields()},
        {5, fields().zeros(2)},
        {6, fields().number(0, 2).zeros(7)},
        {6, fields().number(0xc000, 2).zeros(9)},
        {10, fields().zeros(4)},
        {12, fields().zeros(1).text("azb")},
        {14, fields().zeros(3)},
        {16, fields().zeros(2)},
        {19, fields().zeros(8)},
        {20, fields().zeros(13)},
        {21, fields().number(1U << 9U | 1U, 2).zeros(2)},
        {22, fields().zeros(15)},
        {23, fields().number(0, 1).zeros(6)},
        {23, fields().number(2, 1).zeros(7)},
        {23, fields().number(5, 1).zeros(14)},
        {24, fields().zeros(1)},
        {26, fields().text("centre")},
        {27, fields()},
        {28, fields()},
        {29, fields().zeros(9)},
        {31, fields().text("the end")},
        {32, fields().zeros(1)},
        {33, fields()},
        {34, fields()},
        {35, fields()},
        {36, fields().zeros(3)},
        {37, fields().zeros(5)},
        {39, fields().zeros(2)},
        {43, fields().number(2, 1).zeros(12)},
        {44, fields().zeros(1)},
        {46, fields().zeros(1).text("sound").zeros(2)},
        {47, fields().zeros(2)},
        // An entity with all fields, one of them FTE's: model, frame, colours, skin, effects, 3 x 3, 2, 3
        // bytes.
        {47, fields()
                 .number(0xfe01, 2)
                 .number(0xbf, 1)
                 .number(0x82, 1)
                 .number(0x04, 1)
                 .zeros(5 + 9 + 1 + 3)
                 .zeros(2)},
        // A model's wide number, an entity's number beyond 512, and one that was removed.
        {48,
         fields().zeros(1).number(0x8001, 2).number(0x80, 1).number(0x28, 1).zeros(2).number(0x4001, 2).zeros(
             2)},
        {49, fields().zeros(4)},
        {50, fields().zeros(4)},
        {53, fields().zeros(2)},
        {54, fields().number(2, 1).zeros(14)},
        {60, fields().zeros(2).text("progs/a.mdl").zeros(2)},
        {66, fields().number(1U << 13U | 1U, 2).zeros(1)},
        {84, fields().zeros(3).number(4, 2).zeros(4)},
    };
    for (const Skipped& message : skipped) {
        DemoWriter demo = begun("", {{test::fte, 8U}});
        DemoMessages all;
        all.number(static_cast<std::uint64_t>(message.number), 1);
        for (const std::byte byte : message.content.bytes())
            all.number(static_cast<std::uint64_t>(byte), 1);
        demo.to_reader(10, all.player(2, at({77, 0, 0})));
        const auto match = parse_match(demo.bytes(), "match.mvd");
        ASSERT_TRUE(match) << "message " << message.number << ": " << match.error().message;
        EXPECT_EQ(match->trace.poses.back().origin().x(), 77.0) << "message " << message.number;
    }
}

TEST(Demo, WhatFollowsTheEndOfAConnectionIsNotRead) {
    DemoWriter demo = begun();
    frame(demo, 10, at({0, 0, 0}), at({100, 0, 0}));
    demo.to_everyone(10, DemoMessages().number(2, 1).text("EndOfDemo").number(255, 1));
    EXPECT_EQ(read(demo).trace.frames.size(), 1U);
}

TEST(Demo, UnknownMessagesCostTheRestOfTheirBlock) {
    DemoWriter demo = begun();
    for (int i = 0; i < 120; ++i)
        frame(demo, 10, at({0, 0, 0}), at({100, 0, 0}));
    const std::size_t before = demo.bytes().size();
    frame(demo, 10, at({50, 0, 0}), at({0, 0, 0}), DemoMessages().zeros(0).number(99, 1));
    frame(demo, 10, at({8, 0, 0}), at({100, 0, 0}));
    const auto match = parse_match(demo.bytes(), "match.mvd");
    ASSERT_TRUE(match) << match.error().message;
    EXPECT_EQ(match->trace.frames.size(), 121U);
    EXPECT_EQ(match->warning, "match.mvd: 1 of 123 blocks are read only in part; block at byte " +
                                  std::to_string(before + 6) +
                                  ": byte 0 of the block: message 99 is unknown");
}

TEST(Demo, ErrorsNameTheByteAndTheReason) {
    const auto with = [](const DemoMessages& content) {
        DemoWriter demo = begun();
        frame(demo, 10, at({0, 0, 0}), at({100, 0, 0}));
        return error_of(demo.to_everyone(10, content).bytes());
    };
    EXPECT_THAT(
        with(DemoMessages().number(99, 1)),
        HasSubstr("byte 0 of the block: message 99 is unknown; 1 of 3 blocks cannot be read, expected at "
                  "most one in 100"));
    EXPECT_THAT(with(DemoMessages().number(1, 1).number(3, 1)),
                HasSubstr("byte 1 of the block: message 3 ends early"));
    EXPECT_THAT(with(DemoMessages().number(9, 1).number('a', 1)), HasSubstr("message 9 ends early"));
    EXPECT_THAT(with(DemoMessages().player(32, {})),
                HasSubstr("message 42 has a coordinate or a slot out of range"));
    EXPECT_THAT(with(DemoMessages().begin_level({}, 15)), HasSubstr("protocol 15, expected 28"));
    EXPECT_THAT(with(DemoMessages()
                         .begin_level({{test::fte, 8}})
                         .number(47, 1)
                         .number(0x8001, 2)
                         .number(0x80, 1)
                         .number(1, 1)),
                HasSubstr("fields of an unknown extension"));
    EXPECT_THAT(with(DemoMessages()
                         .begin_level({{test::mvd_1, 1}})
                         .number(42, 1)
                         .number(2, 1)
                         .number(1, 2)
                         .zeros(1)
                         .real(NAN)),
                HasSubstr("out of range"));
}

TEST(Demo, ErrorsOfTheContainerNameTheByte) {
    const Bytes whole = begun().bytes();
    const std::string size = std::to_string(whole.size());
    EXPECT_THAT(error_of(whole), HasSubstr("match.mvd: no player in it"));
    EXPECT_THAT(error_of(Bytes(whole.begin(), whole.end() - 1)), HasSubstr("match.mvd: byte 0: a block of "));
    EXPECT_THAT(error_of(DemoWriter(begun()).header(10, 6).bytes()),
                HasSubstr("byte " + size + ": the demo ends within the header of a block"));
    EXPECT_THAT(error_of(DemoWriter(begun()).number(10, 1).bytes()),
                HasSubstr("byte " + size + ": the demo ends"));
    EXPECT_THAT(error_of(DemoWriter(begun()).header(10, 2).number(0, 4).bytes()), HasSubstr("byte " + size));
    EXPECT_THAT(error_of(DemoWriter(begun()).header(10, 7).bytes()),
                HasSubstr("a block of type 7, expected 1 to 6"));
    EXPECT_THAT(error_of(DemoWriter(begun()).header(10, 0).bytes()), HasSubstr("(.qwd)"));
    EXPECT_THAT(error_of(DemoWriter(begun()).header(10, 6).number(0xffffffff, 4).bytes()),
                HasSubstr("a block of 4294967295 bytes, expected at most 1048576"));
}

TEST(Demo, ThatIsCutOffIsReadToThere) {
    DemoWriter demo = begun();
    for (int i = 0; i < 3; ++i)
        frame(demo, 10, at({8, 16, 24}), at({100, 0, 0}));
    const Bytes& whole = demo.bytes();
    const auto match = parse_match(std::span(whole).first(whole.size() - 1), "match.mvd");
    ASSERT_TRUE(match) << match.error().message;
    EXPECT_EQ(match->trace.frames.size(), 2U);
    EXPECT_THAT(match->warning, HasSubstr("match.mvd: is cut off; byte "));
    EXPECT_THAT(parse_match(whole, "match.mvd")->warning, testing::IsEmpty());
}

TEST(Demo, MayBeCompressed) {
    DemoWriter demo = begun();
    frame(demo, 10, at({8, 16, 24}), at({100, 0, 0}));
    const std::string text(reinterpret_cast<const char*>(demo.bytes().data()), demo.bytes().size());
    const std::string packed = test::gzip(text);
    const auto match = parse_match(std::as_bytes(std::span(packed)), "match.mvd.gz");
    ASSERT_TRUE(match) << match.error().message;
    EXPECT_EQ(match->trace.poses.size(), 2U);
    const auto cut = parse_match(std::as_bytes(std::span(packed)).first(packed.size() - 9), "match.mvd.gz");
    ASSERT_FALSE(cut);
    EXPECT_EQ(cut.error().message, "match.mvd.gz: compressed data end too early");
}

TEST(Demo, ATableOfPosesIsReadAsOne) {
    const std::string_view table =
        "t_ms,player,x,y,z,pitch,yaw,roll,vx,vy,vz,viewheight,team,teleport_bit,alive\n"
        "8,3,1,2,3,0,0,0,0,0,0,26,0,0,1\n";
    const auto match = parse_match(std::as_bytes(std::span(table)), "match.csv");
    ASSERT_TRUE(match) << match.error().message;
    EXPECT_EQ(match->trace.players.front(), 3U);
    EXPECT_FALSE(match->events);
}

// What is in the file comes out, whatever moves how.
RC_GTEST_PROP(DemoProperty, OriginsAndTimesComeOutAsTheyWentIn, ()) {
    DemoWriter demo = begun();
    struct Step {
        int after;
        Vec3d origin;
        bool dead;
    };
    std::vector<Step> steps;
    const auto count = *rc::gen::inRange(1, 30);
    for (int i = 0; i < count; ++i) {
        Step step{*rc::gen::inRange(1, 256), Vec3d::Zero(), *rc::gen::inRange(0, 5) == 0};
        for (int axis = 0; axis < 3; ++axis)
            step.origin[axis] = *rc::gen::inRange(-32768, 32768) / 8.0;
        frame(demo, step.after, {.origin = step.origin, .dead = step.dead}, at({100, 0, 0}));
        steps.push_back(step);
    }
    const RecordedMatch match = read(demo);
    RC_ASSERT(match.trace.frames.size() == steps.size());
    std::int64_t time = 0;
    for (std::size_t i = 0; i < steps.size(); ++i) {
        time += steps[i].after;
        RC_ASSERT(match.trace.frames[i].time == time * 1'000'000);
        RC_ASSERT(match.trace.poses[2 * i].origin() == steps[i].origin);
        RC_ASSERT(match.trace.poses[2 * i].alive == !steps[i].dead);
    }
}

void expect_valid(const RecordedMatch& match, std::size_t size) {
    const Trace& trace = match.trace;
    constexpr std::size_t least_pose = 5;  // bytes
    ASSERT_LE(trace.poses.size() * least_pose, size);
    ASSERT_LE(trace.frames.size(), trace.poses.size());
    std::int64_t last = -1;
    for (const TraceFrame& frame : trace.frames) {
        ASSERT_GT(frame.time, last);
        ASSERT_GE(frame.pose_count, 1U);
        last = frame.time;
        for (const TracePose& pose : trace.poses_of(frame)) {
            ASSERT_TRUE(pose.eye.allFinite() && pose.velocity.allFinite());
            ASSERT_NEAR(pose.orientation.norm(), 1.0, 1e-9);
            ASSERT_LT(pose.player, trace.players.size());
        }
    }
    std::int64_t before = 0;
    for (const TraceEvent& event : match.events.value_or(std::vector<TraceEvent>{})) {
        ASSERT_GE(event.time, before);
        before = event.time;
        ASSERT_TRUE(event.actor || event.subject);
        ASSERT_LT(std::max(event.actor.value_or(0), event.subject.value_or(0)), trace.players.size());
    }
}

// Whatever the bytes: an error with a message, or a match that keeps its invariants.
RC_GTEST_PROP(DemoProperty, DamageNeverBreaksInvariants, ()) {
    DemoWriter demo = begun("", {{test::fte, 8U}});
    for (int i = 0; i < 40; ++i) {
        frame(demo, 10, at({8.0 * i, 16, 24}), at({100, 0, 0}),
              DemoMessages().print(1, "anna rides bert's rocket\n").teleport_flash({1, 2, 3}));
        demo.stats(0, 2, DemoMessages().stat(0, 100).long_stat(15, 1 << (i % 30)));
        demo.hidden(3, DemoMessages().hidden_damage(3, 6, 110));
    }
    Bytes bytes = demo.bytes();
    const auto damages = *rc::gen::inRange(1, 6);
    for (int i = 0; i < damages; ++i)
        bytes[*rc::gen::inRange<std::size_t>(0, bytes.size())] =
            static_cast<std::byte>(*rc::gen::inRange(0, 256));
    if (*rc::gen::inRange(0, 4) == 0) bytes.resize(*rc::gen::inRange<std::size_t>(0, bytes.size()));
    const auto match = parse_match(bytes, "match.mvd");
    if (!match) {
        RC_ASSERT(!match.error().message.empty());
        return;
    }
    expect_valid(*match, bytes.size());
    RC_ASSERT(!testing::Test::HasFatalFailure());
}

// As the other reader writes them, without the lightning gun, which it does not know as an item.
std::multiset<std::string> rows_of(const std::vector<TraceEvent>& events, std::int64_t begin) {
    std::multiset<std::string> rows;
    for (const TraceEvent& event : events)
        if (event.detail != "lg" || event.kind != "item")
            rows.insert(std::to_string((event.time - begin) / 1'000'000) + " " + event.kind + " " +
                        std::to_string(event.actor.value_or(99)) + " " +
                        std::to_string(event.subject.value_or(99)) + " " + event.detail);
    return rows;
}

// A duel of people, and what another reader made of it at 62.5 Hz.
TEST(Demo, OfPeopleIsAsAnotherReaderReadsIt) {
    const std::string folder = "traces/human/";
    const auto demo = test::shared_file(folder + "demos/dm3-duel1.mvd");
    const auto table = test::shared_file(folder + "dm3-duel1-60hz.csv.gz");
    const auto events = test::shared_file(folder + "dm3-duel1-events.csv.gz");
    if (!demo || !table || !events) GTEST_SKIP() << test::needs_shared_file(folder + "demos/dm3-duel1.mvd");
    const auto match = read_match(*demo);
    ASSERT_TRUE(match) << match.error().message;
    EXPECT_EQ(match->warning, "");
    const auto expected = read_match(*table);
    ASSERT_TRUE(expected) << expected.error().message;
    const auto frames = resample(match->trace, 62.5);
    ASSERT_TRUE(frames) << frames.error().message;
    EXPECT_EQ(frames->players, expected->trace.players);
    const std::int64_t begin = match->trace.frames.front().time;
    ASSERT_EQ(frames->frames.size(), expected->trace.frames.size());
    for (std::size_t i = 0; i < frames->frames.size(); ++i)
        ASSERT_EQ(frames->frames[i].time - begin, expected->trace.frames[i].time);
    ASSERT_EQ(frames->poses.size(), expected->trace.poses.size());
    constexpr double rounding = 0.0051;  // units
    for (std::size_t i = 0; i < frames->poses.size(); ++i) {
        const TracePose& pose = frames->poses[i];
        const TracePose& other = expected->trace.poses[i];
        ASSERT_EQ(pose.player, other.player) << i;
        ASSERT_EQ(pose.alive, other.alive) << i;
        ASSERT_EQ(pose.discontinuity, other.discontinuity) << i;
        ASSERT_EQ(pose.team, other.team) << i;
        // Towards a death resample() does not interpolate, the other reader does.
        if (!pose.alive || (i + 2 < frames->poses.size() && !frames->poses[i + 2].alive)) continue;
        ASSERT_LT((pose.origin() - other.origin()).cwiseAbs().maxCoeff(), rounding) << i;
        ASSERT_LT(pose.orientation.angularDistance(other.orientation), 0.05) << i;
    }
    const auto told = read_events(*events, expected->trace);
    ASSERT_TRUE(told) << told.error().message;
    EXPECT_EQ(rows_of(*match->events, begin), rows_of(*told, 0));
}

}  // namespace
}  // namespace camdir::evaluation
