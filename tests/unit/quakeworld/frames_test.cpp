#include "quakeworld/frames.hpp"

#include <gtest/gtest.h>

#include "support/demo_writer.hpp"

namespace camdir::quakeworld {
namespace {

using camdir::test::DemoMessages;
using camdir::test::DemoWriter;

DemoMessages level(std::string_view map) {
    return DemoMessages().begin_level().models({map, "progs/player.mdl"});
}

std::vector<Frame> read(FrameReader& reader, const DemoWriter& demo) {
    BlockReader blocks;
    blocks.append(demo.bytes());
    std::vector<Frame> frames;
    while (const auto block = blocks.next().value())
        if (auto frame = reader.read(*block)) frames.push_back(std::move(*frame));
    return frames;
}

TEST(Frames, ALevelForgetsTheOneBefore) {
    DemoWriter demo;
    demo.to_everyone(0, level("maps/dm3.bsp").user_info(2, R"(\name\anna)"));
    demo.to_everyone(10, DemoMessages().player(2, {}));
    demo.to_everyone(10, DemoMessages().player(2, {}));
    demo.to_everyone(0, level("maps/e1m2.bsp").user_info(5, R"(\name\bert)"));
    demo.to_everyone(10, DemoMessages().player(5, {}));
    demo.to_everyone(10, DemoMessages());
    FrameReader reader;
    const auto frames = read(reader, demo);
    ASSERT_EQ(frames.size(), 2U) << "the one in which the level began is discarded";
    EXPECT_EQ(frames[0].time, 10);
    EXPECT_EQ(frames[1].time, 30);
    EXPECT_EQ(frames[1].poses.at(0).slot, 5);
    EXPECT_EQ(reader.levels(), 2U);
    EXPECT_EQ(reader.map(), "e1m2");
    EXPECT_EQ(reader.clients()[2].name, "");
    EXPECT_EQ(reader.clients()[5].name, "bert");
}

TEST(Frames, TheMapIsTheFirstModel) {
    FrameReader reader;
    (void)read(reader, DemoWriter().to_everyone(0, level("progs/player.mdl")));
    EXPECT_EQ(reader.map(), "");
    (void)read(reader, DemoWriter().to_everyone(0, level("maps/a/b.bsp")));
    EXPECT_EQ(reader.map(), "a/b");
}

TEST(Frames, NamesAreOfBoundedLength) {
    const std::string name(10'000, 'a');
    FrameReader reader;
    (void)read(reader,
               DemoWriter().to_everyone(
                   0, level("maps/" + name + ".bsp").user_key(2, "name", name).user_key(2, "team", name)));
    EXPECT_EQ(reader.map(), "") << "no map of a server";
    EXPECT_EQ(reader.clients()[2].name.size(), 255U);
    EXPECT_EQ(reader.clients()[2].team.size(), 255U);
}

TEST(Frames, MatchesBeginAndEndAgainAndAgain) {
    DemoWriter demo;
    demo.to_everyone(0, level("maps/dm3.bsp").user_info(2, R"(\name\anna)"));
    for (int match = 0; match < 2; ++match) {
        demo.to_everyone(10, DemoMessages().server_key("status", "10 min left").player(2, {}));
        demo.to_everyone(10, DemoMessages().server_key("status", "9 min left").player(2, {}));
        demo.to_everyone(10, DemoMessages().server_key("status", "Standby").player(2, {}));
    }
    demo.to_everyone(10, DemoMessages());
    FrameReader reader;
    std::vector<Occurrence::Kind> kinds;
    for (const Frame& frame : read(reader, demo))
        for (const Occurrence& occurrence : frame.occurrences)
            kinds.push_back(occurrence.kind);
    using Kind = Occurrence::Kind;
    EXPECT_EQ(kinds, (std::vector{Kind::match_begin, Kind::match_end, Kind::match_begin, Kind::match_end}));
}

TEST(Frames, NoPlayersNameBeginsOrEndsAMatch) {
    DemoWriter demo;
    demo.to_everyone(0, level("maps/dm3.bsp").user_info(2, R"(\name\The match is over)"));
    const auto prints = [&](int print_level, std::string_view line) {
        demo.to_everyone(10, DemoMessages().print(print_level, line).player(2, {}));
    };
    prints(2, "The match has begun!\n");
    prints(1, "The match is over was gibbed by anna's rocket\n");
    prints(2, "The match is over entered the game\n");
    prints(1, "The match is over\n");
    demo.to_everyone(10, DemoMessages());
    FrameReader reader;
    std::vector<Occurrence::Kind> kinds;
    const auto collect = [&](const std::vector<Frame>& frames) {
        for (const Frame& frame : frames)
            for (const Occurrence& occurrence : frame.occurrences)
                if (occurrence.kind != Occurrence::Kind::obituary) kinds.push_back(occurrence.kind);
    };
    collect(read(reader, demo));
    EXPECT_EQ(kinds, std::vector{Occurrence::Kind::match_begin});
    DemoWriter end;
    end.to_everyone(10, DemoMessages().print(2, "\xd4\xe8\xe5 match is over\n").player(2, {}));
    end.to_everyone(10, DemoMessages());
    collect(read(reader, end));
    EXPECT_EQ(kinds.size(), 2U) << "in letters of another colour";
}

TEST(Frames, ALevelWhoseBeginCannotBeReadIsAnErrorAtOnce) {
    DemoWriter demo;
    demo.to_everyone(0, level("maps/dm3.bsp"));
    for (int i = 0; i < 1000; ++i)
        demo.to_everyone(10, DemoMessages().player(2, {}));
    FrameReader reader;
    (void)read(reader, demo);
    EXPECT_TRUE(reader.expect_readable());
    (void)read(reader, DemoWriter().to_everyone(0, DemoMessages().begin_level({}, 29)));
    const auto readable = reader.expect_readable();
    ASSERT_FALSE(readable);
    EXPECT_NE(readable.error().message.find("protocol 29, expected 28"), std::string::npos);
}

TEST(Frames, WhatCanBeReadIsJudgedByTheLastBlocks) {
    FrameReader reader;
    const auto pass = [&](int count, const DemoMessages& messages) {
        DemoWriter demo;
        for (int i = 0; i < count; ++i)
            demo.to_everyone(10, messages);
        (void)read(reader, demo);
    };
    const DemoMessages unknown = DemoMessages().number(255, 1);
    pass(100'000, DemoMessages().player(2, {}));
    pass(50, unknown);
    EXPECT_TRUE(reader.expect_readable());
    pass(100, unknown);
    EXPECT_FALSE(reader.expect_readable()) << "0.15 % of all, but 1.5 % of the last";
}

TEST(Frames, NamesHaveNoLineFeeds) {
    FrameReader reader;
    (void)read(reader,
               DemoWriter().to_everyone(
                   0, level("maps/dm\n3.bsp").user_key(2, "name", "an\nna").user_key(3, "name", "b\x8at")));
    EXPECT_EQ(reader.map(), "dm?3");
    EXPECT_EQ(reader.clients()[2].name, "an?na");
    EXPECT_EQ(reader.clients()[3].name, "b?t");
}

TEST(Frames, ThatNeverEndDoNotGrow) {
    DemoWriter demo;
    demo.to_everyone(0, level("maps/dm3.bsp"));
    for (int i = 0; i < 3000; ++i)
        demo.to_everyone(0, DemoMessages().teleport_flash({0, 0, 0}))
            .hidden(0, DemoMessages().hidden_damage(1, 2, 3));
    demo.to_everyone(1, DemoMessages());
    FrameReader reader;
    const auto frames = read(reader, demo);
    ASSERT_EQ(frames.size(), 1U);
    EXPECT_EQ(frames[0].flashes.size(), 1024U);
    EXPECT_EQ(frames[0].occurrences.size(), 1024U);
}

}  // namespace
}  // namespace camdir::quakeworld
