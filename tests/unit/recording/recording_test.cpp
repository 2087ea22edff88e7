#include <gmock/gmock.h>

#include <fstream>
#include <limits>
#include <random>

#include "freespace/shape_checks.hpp"
#include "recording/bytes.hpp"
#include "recording/reader.hpp"
#include "recording/writer.hpp"
#include "support/temporary_folder.hpp"

namespace camdir::recording {
namespace {

using ::testing::HasSubstr;
constexpr std::uint64_t unlimited = 1ULL << 40;

Start start_of_match() {
    Start start;
    start.match.match_id = "m";
    start.match.map_name = "square";
    start.match.map_hash = 7;
    start.match.players = {{0, "a", "soldier", 1}, {1, "b", "", 2}};
    start.director_version = "0.1.0";
    return start;
}

// The encoding of one record alone shows every bit of it.
Bytes bytes_of(const std::vector<Message>& messages) {
    RecordEncoder encoder(0);
    for (const Message& message : messages)
        encoder.add(0, message);
    return encoder.content();
}

Message random_message(std::mt19937& random) {
    const auto number = [&] { return std::uniform_real_distribution<float>(-4096.0F, 4096.0F)(random); };
    const auto vector = [&] { return Vec3f(number(), number(), number()); };
    const auto direction = [&] { return Quatf(number(), number(), number(), number()).normalized(); };
    switch (random() % 8) {
        case 0: {
            director::MatchInfo info = start_of_match().match;
            info.epoch = random() % 2;
            info.players.resize(random() % 3);
            return info;
        }
        case 1: {
            director::PoseFrame frame{random() % 2, static_cast<std::uint32_t>(random()), -5, 9, {}};
            for (std::uint32_t id = 0; id < 3; ++id)
                if (random() % 3 != 0) frame.poses.push_back({id, vector(), direction(), vector(), 5, {}});
            if (!frame.poses.empty()) frame.poses[0].discontinuities = static_cast<std::uint32_t>(random());
            return frame;
        }
        case 2:
            return director::MatchEvent{1, 2, 3, 0, director::no_player, number(), "rocket"};
        case 3:
            return director::ObserverRequest{"m",  std::to_string(random() % 3),       1, {1, 2}, "default",
                                             "{}", static_cast<std::uint8_t>(random())};
        case 4:
            return Withdrawal{std::to_string(random() % 3)};
        case 5: {
            director::MoverInfo info{random() % 2, {{3, {"*3", "func_door", {}, {}}}, {200, {}}}};
            freespace::MoverShape& cart = info.movers[1].shape;
            cart.balls.push_back({vector(), 1.0F + std::abs(number())});
            cart.hulls.push_back({});
            for (int axis = 0; axis < 3; ++axis)
                for (const float side : {-1.0F, 1.0F})
                    cart.hulls[0].half_spaces.push_back(
                        {side * Vec3f::Unit(axis), 1.0F + std::abs(number())});
            cart.hulls[0].bounds = *freespace::bounds_of(cart.hulls[0].half_spaces);
            return info;
        }
        case 6:
            return director::MoverFrame{
                random() % 2, -7, 8, {{3, vector(), direction()}, {200, vector(), direction()}}};
        default: {
            director::CameraFrame frame{1, static_cast<std::uint32_t>(random()), 3, 4, 5, {}, {}};
            frame.cameras.push_back({8, 1, vector(), direction(), 1.5F, number(), 3});
            if (random() % 2 == 0) frame.reasons.push_back({8, {1, director::no_player, "duel"}});
            return frame;
        }
    }
}

// About 20 records in each fragment of 3 s.
std::vector<Record> write_random(const std::filesystem::path& folder, std::size_t count,
                                 std::uint64_t max_bytes) {
    std::mt19937 random(17);
    auto writer = Writer::create(folder, start_of_match(), max_bytes);
    std::vector<Record> records;
    std::int64_t time = 1'000'000'000'000'000'000;
    for (std::size_t i = 0; i < count; ++i) {
        records.push_back({time += 150'000'000, random_message(random)});
        EXPECT_TRUE(writer->append(records.back()));
    }
    EXPECT_TRUE(writer->finish());
    return records;
}

TEST(Recording, RandomRecordsComeBackBitExactly) {
    const test::TemporaryFolder folder;
    const auto written = write_random(folder / "r", 400, unlimited);
    const auto reader = Reader::open(folder / "r");
    ASSERT_TRUE(reader) << reader.error().message;
    EXPECT_EQ(reader->start().match, start_of_match().match);
    std::size_t i = 0;
    ASSERT_TRUE(reader
                    ->replay(0,
                             [&](const Record& record) {
                                 ASSERT_LT(i, written.size());
                                 EXPECT_EQ(record.time, written[i].time);
                                 EXPECT_EQ(bytes_of({record.message}), bytes_of({written[i].message})) << i;
                                 ++i;
                             })
                    .empty());
    EXPECT_EQ(i, written.size());
}

TEST(Recording, FullFollowsFromTheFullAndDeltaBefore) {
    const test::TemporaryFolder folder;
    write_random(folder / "r", 400, unlimited);
    const auto reader = Reader::open(folder / "r");
    ASSERT_TRUE(reader);
    ASSERT_GE(reader->last_fragment(), 10U);
    for (std::uint32_t n = 0; n < reader->last_fragment(); ++n) {
        State state = *reader->full(n);
        const auto delta = reader->delta(n);
        for (const Record& record : *delta)
            state.apply(record.message);
        EXPECT_EQ(bytes_of(state.messages()), bytes_of(reader->full(n + 1)->messages())) << n;
    }
}

std::vector<std::uint32_t> movers_placed_in(const State& state) {
    std::vector<std::uint32_t> ids;
    for (const director::MoverPose& pose : state.mover_frame->poses)
        ids.push_back(pose.mover_id);
    return ids;
}

director::MoverFrame places_of(const std::vector<std::uint32_t>& movers, std::uint64_t epoch = 1) {
    director::MoverFrame frame{epoch, 0, 0, {}};
    for (const std::uint32_t id : movers)
        frame.poses.push_back({id, Vec3f::Zero(), Quatf::Identity()});
    return frame;
}

TEST(Recording, AMoverThatAFrameLeavesOutStaysWhereItWas) {
    State state;
    state.apply(director::MoverInfo{1, {{3, {}}, {200, {}}}});
    state.apply(places_of({3, 200, 7}));
    EXPECT_EQ(movers_placed_in(state), (std::vector<std::uint32_t>{3, 7, 200})) << "7 may be listed later";
    director::MoverFrame moved = places_of({200});
    moved.poses[0].position.x() = 5.0F;
    state.apply(moved);
    EXPECT_EQ(movers_placed_in(state), (std::vector<std::uint32_t>{3, 200}));
    EXPECT_EQ(state.mover_frame->poses[1].position.x(), 5.0F);
    state.apply(director::MoverInfo{1, {{200, {}}}});
    state.apply(places_of({200}));
    EXPECT_EQ(movers_placed_in(state), (std::vector<std::uint32_t>{200}));
    state.apply(places_of({4}, 2));
    EXPECT_EQ(movers_placed_in(state), (std::vector<std::uint32_t>{4})) << "another epoch";
}

TEST(Recording, AStateHasNoMoreMoversThanAFrameTakes) {
    director::MoverInfo listed{1, {}};
    std::vector<std::uint32_t> first, second;
    for (std::uint32_t id = 0; id < freespace::max_movers; ++id) {
        listed.movers.push_back({id, {}});
        first.push_back(id);
        second.push_back(id + 1000);
    }
    State state;
    state.apply(listed);
    state.apply(places_of(first));
    state.apply(places_of(second));
    EXPECT_EQ(movers_placed_in(state), first);
}

TEST(Recording, CamerasKeepTheReasonsOfTheirCuts) {
    director::CameraFrame frame{1, 2, 3, 4, 5, {}, {}};
    frame.reasons = {{8, {1, 2, "duel"}}, {9, {director::no_player, director::no_player, ""}}};
    RecordEncoder encoder(0);
    encoder.add(0, frame);
    const auto records = decode_records({ResourceKind::delta, 0, 0, encoder.content()}, "r");
    ASSERT_TRUE(records) << records.error().message;
    const auto& reasons = std::get<director::CameraFrame>(records->at(0).message).reasons;
    ASSERT_EQ(reasons.size(), 2U);
    EXPECT_EQ(reasons[0].camera_id, 8U);
    EXPECT_EQ(reasons[0].reason.actor, 1U);
    EXPECT_EQ(reasons[0].reason.subject, 2U);
    EXPECT_EQ(reasons[0].reason.why, "duel");
    EXPECT_EQ(reasons[1].reason.actor, director::no_player);
}

TEST(Recording, CamerasOfTheFirstVersionHaveNoReasons) {
    ByteSink body;
    body.difference(0);
    for (const int number : {1, 2, 3})
        body.varint(static_cast<std::uint64_t>(number));
    body.difference(4);
    body.difference(5);
    body.varint(0);  // cameras; the record ends here
    ByteSink content;
    content.varint(6);
    content.varint(body.bytes.size());
    content.append(body.bytes);
    const auto records = decode_records({ResourceKind::delta, 0, 0, content.bytes}, "r");
    ASSERT_TRUE(records) << records.error().message;
    const auto& frame = std::get<director::CameraFrame>(records->at(0).message);
    EXPECT_EQ(frame.pose_number, 3U);
    EXPECT_EQ(frame.source_time, 5);
    EXPECT_TRUE(frame.reasons.empty());
}

TEST(Recording, ATimeIsFoundInItsFragment) {
    const test::TemporaryFolder folder;
    write_random(folder / "r", 400, unlimited);
    const auto reader = Reader::open(folder / "r");
    for (std::uint32_t n = 0; n <= reader->last_fragment(); ++n)
        EXPECT_EQ(reader->fragment_at(reader->delta(n)->back().time), n);
    EXPECT_EQ(reader->fragment_at(0), 0U);
}

// Whole blocks, and one for the folder.
std::uint64_t disk_of_fragments(const std::filesystem::path& folder, const Reader& reader) {
    std::uint64_t bytes = 0;
    for (std::uint32_t n = reader.first_fragment(); n <= reader.last_fragment(); ++n) {
        bytes += 4096;
        for (const char* name : {"full", "delta"})
            bytes += (std::filesystem::file_size(folder / std::to_string(n) / name) + 4095) / 4096 * 4096;
    }
    return bytes;
}

TEST(Recording, RotationRemovesTheOldestFragments) {
    const test::TemporaryFolder folder;
    write_random(folder / "r", 400, 50'000);
    const auto reader = Reader::open(folder / "r");
    ASSERT_TRUE(reader);
    EXPECT_GT(reader->first_fragment(), 0U);
    EXPECT_GT(reader->last_fragment(), reader->first_fragment());
    EXPECT_FALSE(std::filesystem::exists(folder / "r" / "0"));
    EXPECT_LE(disk_of_fragments(folder / "r", *reader), 50'000U);
    EXPECT_TRUE(reader->replay(0, [](const Record&) {}).empty());
}

TEST(Recording, TheOldestFragmentCanBeRemoved) {
    const test::TemporaryFolder folder;
    auto writer = Writer::create(folder / "r", start_of_match(), unlimited);
    for (std::int64_t time = 0; time < 4; ++time)
        ASSERT_TRUE(writer->append({time * 3'000'000'000, Withdrawal{"x"}}));
    ASSERT_EQ(writer->written().size(), 3U);
    EXPECT_EQ(writer->written()[1].begin_time, 3'000'000'000);
    ASSERT_TRUE(writer->remove_oldest());
    const auto reader = Reader::open(folder / "r");
    EXPECT_EQ(reader->first_fragment(), 1U);
    EXPECT_EQ(reader->last_fragment(), 2U);
    std::uint64_t bytes = 0;
    for (const Writer::Written& fragment : writer->written())
        bytes += fragment.bytes;
    EXPECT_EQ(bytes, disk_of_fragments(folder / "r", *reader));
}

TEST(Recording, AFragmentEndsWithoutTheNextRecord) {
    const test::TemporaryFolder folder;
    auto writer = Writer::create(folder / "r", start_of_match(), unlimited);
    ASSERT_TRUE(writer->append({5, Withdrawal{"x"}}));
    ASSERT_TRUE(writer->advance(3'000'000'004));
    EXPECT_TRUE(writer->written().empty());
    ASSERT_TRUE(writer->advance(3'000'000'005));
    ASSERT_TRUE(writer->advance(9'000'000'005));
    EXPECT_EQ(writer->written().size(), 1U);
    ASSERT_TRUE(writer->append({9'000'000'005, Withdrawal{"x"}}));
    ASSERT_TRUE(writer->finish());
    const auto reader = Reader::open(folder / "r");
    EXPECT_EQ(reader->last_fragment(), 1U);
    EXPECT_EQ(reader->delta(1)->front().time, 9'000'000'005);
}

TEST(Recording, WhatAKilledWriterLeftIsIgnored) {
    const test::TemporaryFolder folder;
    write_random(folder / "r", 100, unlimited);
    const auto before = Reader::open(folder / "r");
    const auto next = folder / "r" / std::to_string(before->last_fragment() + 1);
    std::filesystem::create_directory(next);
    std::ofstream(next / "full.aB3dE6") << "half";
    std::ofstream(next / "delta") << "half";
    const auto reader = Reader::open(folder / "r");
    ASSERT_TRUE(reader);
    EXPECT_EQ(reader->last_fragment(), before->last_fragment());
    EXPECT_TRUE(reader->replay(0, [](const Record&) {}).empty());
}

TEST(Recording, TruncatedAndFlippedBytesAreErrors) {
    const Bytes whole = encode_start(start_of_match());
    ASSERT_TRUE(decode_start(whole, "start"));
    for (std::size_t size = 0; size < whole.size(); ++size) {
        const auto start = decode_start(std::span(whole).first(size), "start");
        ASSERT_FALSE(start) << size;
        EXPECT_THAT(start.error().message, HasSubstr("start: byte "));
    }
    for (std::size_t bit = 0; bit < whole.size() * 8; ++bit) {
        Bytes damaged = whole;
        damaged[bit / 8] ^= static_cast<std::byte>(1U << (bit % 8));
        EXPECT_FALSE(decode_start(damaged, "start")) << bit;
    }
}

TEST(Recording, FragmentsAreReadWholeOrNotAtAll) {
    const test::TemporaryFolder folder;
    write_random(folder / "r", 40, unlimited);
    for (const char* name : {"full", "delta"}) {
        const Bytes whole = *read_file(folder / "r" / "1" / name);
        ASSERT_TRUE(decode_resource(whole, name));
        for (std::size_t i = 0; i < whole.size(); ++i) {
            const auto cut = decode_resource(std::span(whole).first(i), name);
            ASSERT_FALSE(cut) << i;
            EXPECT_THAT(cut.error().message, HasSubstr(": byte "));
        }
    }
}

TEST(Recording, AMajorVersionIsRefusedWithAdvice) {
    Bytes bytes = encode_start(start_of_match());
    bytes[4] = std::byte{2};
    EXPECT_THAT(decode_start(bytes, "start").error().message,
                HasSubstr("byte 4: format version 2, expected 1: read it with the release that wrote it"));
}

Bytes record_of(std::uint64_t kind, const ByteSink& body) {
    ByteSink sink;
    sink.varint(kind);
    sink.varint(body.bytes.size());
    sink.append(body.bytes);
    return sink.bytes;
}

TEST(Recording, RequestsOfOlderVersionsAreForAnyTeam) {
    ByteSink body;
    body.difference(0);
    for (const char* text : {"m", "o"})
        body.text(text);
    body.varint(director::no_player);
    body.varint(0);  // group
    for (const char* text : {"close", "{}"})
        body.text(text);
    const auto records = decode_records({ResourceKind::delta, 0, 0, record_of(4, body)}, "r");
    ASSERT_TRUE(records) << records.error().message;
    const auto& request = std::get<director::ObserverRequest>(records->at(0).message);
    EXPECT_EQ(request.overrides, "{}");
    EXPECT_EQ(request.team, 0);
}

TEST(Recording, UnknownRecordsAndAppendedFieldsAreSkipped) {
    ByteSink sink;
    for (const std::uint64_t kind : {99, 5}) {
        ByteSink body;
        body.difference(1);
        body.text("observer");
        body.text("a later version's field");
        sink.append(record_of(kind, body));
    }
    const auto records = decode_records({ResourceKind::delta, 0, 0, sink.bytes}, "delta");
    ASSERT_TRUE(records) << records.error().message;
    ASSERT_EQ(records->size(), 1U);
    EXPECT_EQ(records->front().time, 2);
    EXPECT_EQ(std::get<Withdrawal>(records->front().message).observer_id, "observer");
}

TEST(Recording, ATimeNeverGoesBackNotEvenRoundTheEnds) {
    using Limits = std::numeric_limits<std::int64_t>;
    for (const auto& [begin, step] :
         {std::pair{std::int64_t{0}, std::int64_t{-1}}, {Limits::min(), -1}, {1, Limits::max()}}) {
        ByteSink body;
        body.difference(step);
        body.text("observer");
        const Resource delta{ResourceKind::delta, 0, begin, record_of(5, body)};
        const auto records = decode_records(delta, "delta");
        ASSERT_FALSE(records) << begin << ' ' << step;
        EXPECT_THAT(records.error().message, HasSubstr("a time not before the last one"));
    }
}

TEST(Recording, ANumberBeyondItsFieldIsAnErrorAndNotAnotherNumber) {
    const auto request_of = [](std::uint64_t target) {
        ByteSink body;
        body.difference(0);
        body.text("match");
        body.text("observer");
        body.varint(target);
        for (int i = 0; i < 3; ++i)
            body.varint(0);  // no group, profile and overrides
        return decode_records({ResourceKind::delta, 0, 0, record_of(4, body)}, "delta");
    };
    ASSERT_TRUE(request_of(0xffffffffU));
    EXPECT_FALSE(request_of(0x100000000U));
    Bytes ten(9, std::byte{0xff});
    ten.push_back(std::byte{1});
    EXPECT_EQ(ByteSource(ten).varint(), std::numeric_limits<std::uint64_t>::max());
    ten.back() = std::byte{2};
    ByteSource beyond(ten);
    (void)beyond.varint();
    EXPECT_FALSE(beyond.ok());
}

TEST(Recording, AFragmentHoldsNoMoreRecordsThanAReaderTakes) {
    const test::TemporaryFolder folder;
    auto writer = Writer::create(folder / "r", start_of_match(), unlimited);
    RecordEncoder all(0);
    for (std::size_t i = 0; i <= max_records; ++i) {
        ASSERT_TRUE(writer->append({0, Withdrawal{}}));
        all.add(0, Withdrawal{});
    }
    ASSERT_TRUE(writer->finish());
    const auto reader = Reader::open(folder / "r");
    ASSERT_TRUE(reader);
    EXPECT_EQ(reader->delta(0)->size(), max_records);
    EXPECT_EQ(reader->delta(1)->size(), 1U);
    const auto records = decode_records({ResourceKind::delta, 0, 0, all.content()}, "delta");
    ASSERT_FALSE(records);
    EXPECT_THAT(records.error().message, HasSubstr("expected at most 131072 records"));
}

TEST(Recording, ATimeThatGoesBackOverAFragmentsEndIsNoPartOfTheRecording) {
    const test::TemporaryFolder folder;
    auto writer = Writer::create(folder / "r", start_of_match(), unlimited);
    ASSERT_TRUE(writer->append({10'000'000'000, Withdrawal{"a"}}));
    ASSERT_TRUE(writer->advance(20'000'000'000));
    ASSERT_EQ(writer->fragments(), 1U);
    EXPECT_FALSE(writer->append({9'000'000'000, Withdrawal{"a"}}));
    EXPECT_TRUE(writer->append({10'000'000'000, Withdrawal{"a"}}));
}

TEST(Recording, ATimeThatGoesBackIsNoPartOfTheRecording) {
    const test::TemporaryFolder folder;
    auto writer = Writer::create(folder / "r", start_of_match(), unlimited);
    ASSERT_TRUE(writer->append({5, Withdrawal{"a"}}));
    EXPECT_THAT(writer->append({4, Withdrawal{"b"}}).error().message, HasSubstr("expected not before 5"));
    ASSERT_TRUE(writer->append({6, Withdrawal{"c"}}));
    ASSERT_TRUE(writer->finish());
    EXPECT_EQ(Reader::open(folder / "r")->delta(0)->size(), 2U);
}

TEST(Recording, AnErrorOfTheDiskEndsTheRecording) {
    const test::TemporaryFolder folder;
    auto writer = Writer::create(folder / "r", start_of_match(), unlimited);
    std::ofstream(folder / "r" / "0") << "in the way";
    ASSERT_TRUE(writer->append({0, Withdrawal{"x"}}));
    const auto failed = writer->append({4'000'000'000, Withdrawal{"x"}});
    ASSERT_FALSE(failed);
    EXPECT_THAT(failed.error().message, HasSubstr("/r/0"));
    EXPECT_EQ(writer->append({5'000'000'000, Withdrawal{"x"}}).error().message, failed.error().message);
}

TEST(Recording, ARemovedFolderDoesNotComeBackWithoutItsStart) {
    const test::TemporaryFolder folder;
    auto writer = Writer::create(folder / "r", start_of_match(), unlimited);
    ASSERT_TRUE(writer->append({0, Withdrawal{"x"}}));
    std::filesystem::remove_all(folder / "r");
    const auto failed = writer->finish();
    ASSERT_FALSE(failed);
    EXPECT_THAT(failed.error().message, HasSubstr("/r/0: cannot create"));
    EXPECT_FALSE(std::filesystem::exists(folder / "r"));
}

}  // namespace
}  // namespace camdir::recording
