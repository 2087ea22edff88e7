#include "stream.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <sstream>

#include "support/demo_writer.hpp"
#include "support/shared_files.hpp"

namespace camdir::qtv {
namespace {

using camdir::test::DemoMessages;
using camdir::test::DemoWriter;
using testing::ElementsAre;
using testing::HasSubstr;

const std::string begin = "QTVSV 1\nBEGIN\n\n";

Bytes stream_of(const Bytes& demo, const std::string& answer = begin) {
    const auto head = std::as_bytes(std::span(answer));
    Bytes bytes(head.begin(), head.end());
    bytes.insert(bytes.end(), demo.begin(), demo.end());
    return bytes;
}

std::string row_of(const Answer& answer) {
    return "answer " + std::to_string(static_cast<int>(answer.kind)) + " " + answer.reason;
}

std::string row_of(const Match& match) {
    std::ostringstream row;
    row << "match " << match.level << " " << match.map << " " << match.rate_hz;
    for (const Player& player : match.players)
        row << " " << int{player.slot} << "=" << player.name << "/" << int{player.team};
    return row.str();
}

std::string row_of(const quakeworld::TrackedFrame& frame) {
    std::ostringstream row;
    row.precision(17);
    row << "frame " << frame.time;
    for (const auto& pose : frame.poses)
        row << " " << int{pose.slot} << ":" << pose.eye.transpose() << ","
            << pose.orientation.coeffs().transpose() << "," << pose.velocity.transpose() << "," << pose.alive
            << pose.discontinuity;
    for (const auto& occurrence : frame.occurrences)
        row << " " << static_cast<int>(occurrence.kind) << "@" << occurrence.time << occurrence.detail;
    return row.str();
}

// Every update, and at last the error if there is one.
std::vector<std::string> read_in_pieces(const Bytes& stream, const std::vector<std::size_t>& sizes) {
    Stream reader;
    std::vector<std::string> rows;
    std::span<const std::byte> rest(stream);
    for (std::size_t i = 0; !rest.empty(); ++i) {
        const auto piece = rest.first(std::min(rest.size(), sizes[i % sizes.size()]));
        reader.append(piece);
        rest = rest.subspan(piece.size());
        while (true) {
            const auto update = reader.next();
            if (!update) {
                rows.push_back("error " + update.error().message);
                return rows;
            }
            if (!*update) break;
            rows.push_back(std::visit([](const auto& said) { return row_of(said); }, **update));
        }
    }
    return rows;
}

std::vector<std::string> read(const Bytes& stream) {
    return read_in_pieces(stream, {stream.size()});
}

std::vector<std::string> beginning_with(const std::vector<std::string>& rows, const std::string& word) {
    std::vector<std::string> found;
    std::ranges::copy_if(rows, std::back_inserter(found),
                         [&](const auto& row) { return row.starts_with(word); });
    return found;
}

DemoMessages level(const std::string& map, const std::string& info) {
    return DemoMessages()
        .begin_level()
        .client_command("fullserverinfo \"" + info + "\"\n")
        .models({"maps/" + map + ".bsp", "progs/player.mdl"})
        .user_info(2, R"(\name\anna\team\red)")
        .user_info(3, R"(\name\carl\*spectator\1)")
        .user_info(5, R"(\name\bert\team\blue)");
}

// So many frames of two players, 40 ms apart.
void play(DemoWriter& demo, int frames) {
    for (int i = 0; i < frames; ++i)
        demo.to_everyone(40, DemoMessages()
                                 .player(2, {.origin = Vec3d(8.0 * i, 0, 0), .model = 2})
                                 .player(5, {.origin = Vec3d(500, 0, 0), .model = 2}));
}

Bytes two_levels() {
    DemoWriter demo;
    demo.to_everyone(0, level("dm3", R"(\teamplay\2)"));
    play(demo, 5);
    demo.to_everyone(0, DemoMessages().print(1, "anna rides bert's rocket\n"));
    play(demo, 4);
    demo.to_everyone(0, DemoMessages().user_info(5, ""));
    play(demo, 4);
    demo.to_everyone(0, level("e1m2", R"(\teamplay\0)"));
    play(demo, 8);
    return demo.bytes();
}

TEST(QtvStream, SaysTheMatchAndItsFrames) {
    const auto rows = read(stream_of(two_levels()));
    EXPECT_EQ(rows.front(), "answer 0 ");
    EXPECT_THAT(beginning_with(rows, "match"),
                ElementsAre("match 1 dm3 30 2=anna/1 5=bert/2", "match 1 dm3 30 2=anna/1",
                            "match 2 e1m2 30 2=anna/0 5=bert/0"));
    const auto frames = beginning_with(rows, "frame");
    EXPECT_EQ(frames.size(), 12U + 3U) << "the last of a level, and those whose next 120 ms are not known";
    EXPECT_EQ(std::ranges::count_if(frames, [](const auto& row) { return row.ends_with("0@200rl"); }), 1);
    const auto second = std::ranges::find(rows, "match 2 e1m2 30 2=anna/0 5=bert/0");
    ASSERT_NE(second, rows.end());
    EXPECT_THAT(*(second - 1), HasSubstr("frame 480 ")) << "the level before is complete";
    EXPECT_THAT(*(second + 1), HasSubstr("frame 560 "));
}

TEST(QtvStream, IsTheSameWhereverItIsParted) {
    const Bytes stream = stream_of(two_levels());
    const auto whole = read(stream);
    EXPECT_EQ(read_in_pieces(stream, {1}), whole);
    for (std::size_t first = 1; first < stream.size(); ++first)
        ASSERT_EQ(read_in_pieces(stream, {first, stream.size()}), whole) << first;
}

TEST(QtvStream, OfPeopleIsTheSameWhereverItIsParted) {
    const auto file = test::shared_file("traces/human/demos/dm3-duel1.mvd");
    if (!file) GTEST_SKIP() << test::needs_shared_file("traces/human/demos/dm3-duel1.mvd");
    const Bytes stream = stream_of(read_file(*file).value());
    const auto whole = read(stream);
    EXPECT_GT(beginning_with(whole, "frame").size(), 1000U);
    EXPECT_THAT(beginning_with(whole, "match").front(), HasSubstr("match 1 dm3 "));
    EXPECT_TRUE(beginning_with(whole, "error").empty());
    for (const std::size_t size : {1, 7, 1000, 1460})
        EXPECT_EQ(read_in_pieces(stream, {size}), whole) << size;
}

TEST(QtvStream, WhoIsNoServerIsRefusedAlikeWhereverTheStreamIsParted) {
    const Bytes stream = stream_of(two_levels(), "QTX 1\n\n");
    const auto whole = read(stream);
    EXPECT_THAT(whole, ElementsAre("error byte 0: 'QTX 1?', expected 'QTVSV ' of a QTV server"));
    for (const std::size_t size : {1, 2, 3, 4})
        EXPECT_EQ(read_in_pieces(stream, {size}), whole) << size;
}

// Damaged or not.
RC_GTEST_PROP(QtvStreamProperty, PiecesMakeNoDifference, ()) {
    Bytes stream = stream_of(two_levels());
    const auto damages = *rc::gen::inRange(0, 4);
    for (int i = 0; i < damages; ++i)
        stream[*rc::gen::inRange<std::size_t>(0, stream.size())] =
            static_cast<std::byte>(*rc::gen::inRange(0, 256));
    const auto sizes = *rc::gen::nonEmpty(
        rc::gen::container<std::vector<std::size_t>>(rc::gen::inRange<std::size_t>(1, 400)));
    RC_ASSERT(read_in_pieces(stream, sizes) == read(stream));
}

TEST(QtvStream, TheRateIsMeasured) {
    DemoWriter demo;
    demo.to_everyone(0, level("dm3", ""));
    play(demo, 60);  // 25 a second, which is not 30
    const auto matches = beginning_with(read(stream_of(demo.bytes())), "match");
    EXPECT_THAT(matches, ElementsAre("match 1 dm3 30 2=anna/0 5=bert/0", "match 1 dm3 25 2=anna/0 5=bert/0"));
}

TEST(QtvStream, APauseOfPlayIsNoRate) {
    DemoWriter demo;
    demo.to_everyone(0, level("dm3", ""));
    play(demo, 10);
    for (int i = 0; i < 240; ++i)
        demo.to_everyone(250, DemoMessages().print(1, "nobody plays\n"));
    play(demo, 10);
    const auto matches = beginning_with(read(stream_of(demo.bytes())), "match");
    EXPECT_THAT(matches, ElementsAre("match 1 dm3 30 2=anna/0 5=bert/0"));
}

TEST(QtvStream, TeamsKeepTheirNumbers) {
    DemoWriter demo;
    demo.to_everyone(0, level("dm3", R"(\teamplay\2)"));
    demo.to_everyone(0, DemoMessages().user_key(2, "team", "blue"));
    demo.to_everyone(0, DemoMessages().user_key(2, "team", "green"));
    EXPECT_THAT(beginning_with(read(stream_of(demo.bytes())), "match"),
                ElementsAre("match 1 dm3 30 2=anna/1 5=bert/2", "match 1 dm3 30 2=anna/2 5=bert/2",
                            "match 1 dm3 30 2=anna/3 5=bert/2"));
}

TEST(QtvStream, ErrorsSayWhatAndWhere) {
    const auto error_of = [](const Bytes& stream) { return read(stream).back(); };
    EXPECT_EQ(error_of(stream_of({}, "SSH-2.0-x\n")),
              "error byte 0: 'SSH-2.', expected 'QTVSV ' of a QTV server");
    EXPECT_EQ(error_of(stream_of(DemoWriter().header(0, 7).bytes())),
              "error byte 0: a block of type 7, expected 1 to 6");
    DemoWriter nowhere;
    nowhere.to_everyone(0, DemoMessages().begin_level());
    play(nowhere, 2);
    EXPECT_THAT(error_of(stream_of(nowhere.bytes())), HasSubstr("players, but of no map"));
    DemoWriter unreadable;
    unreadable.to_everyone(0, level("dm3", ""));
    for (int i = 0; i < 100; ++i)
        unreadable.to_everyone(40, DemoMessages().number(99, 1));
    EXPECT_THAT(error_of(stream_of(unreadable.bytes())),
                HasSubstr("message 99 is unknown; 99 of 100 blocks"));
}

}  // namespace
}  // namespace camdir::qtv
