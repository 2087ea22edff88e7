#include "quakeworld/blocks.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <string>
#include <tuple>
#include <vector>

#include "support/demo_writer.hpp"

namespace camdir::quakeworld {
namespace {

using camdir::test::DemoMessages;
using camdir::test::DemoWriter;
using testing::HasSubstr;

using Row = std::tuple<std::int64_t, std::size_t, Bytes, Audience, int>;

// All blocks that are complete, and how it ends.
struct Read {
    std::vector<Row> blocks;
    std::string end;  // the error, or that of expect_end()

    friend bool operator==(const Read&, const Read&) = default;
};

void take_blocks(BlockReader& reader, Read& read) {
    while (read.end.empty()) {
        const auto block = reader.next();
        if (!block)
            read.end = block.error().message;
        else if (!*block)
            return;
        else
            read.blocks.emplace_back((*block)->time, (*block)->offset,
                                     Bytes((*block)->content.begin(), (*block)->content.end()),
                                     (*block)->audience, (*block)->slot);
    }
}

// In pieces of these sizes, over and over.
Read read_in_pieces(const Bytes& demo, const std::vector<std::size_t>& sizes) {
    BlockReader reader;
    Read read;
    std::span<const std::byte> rest(demo);
    for (std::size_t i = 0; !rest.empty() && read.end.empty(); ++i) {
        const auto piece = rest.first(std::min(rest.size(), sizes[i % sizes.size()]));
        reader.append(piece);
        rest = rest.subspan(piece.size());
        take_blocks(reader, read);
    }
    if (!read.end.empty()) return read;
    if (const auto end = reader.expect_end(); !end) read.end = end.error().message;
    return read;
}

Bytes example() {
    return DemoWriter()
        .to_everyone(0, DemoMessages().print(2, "hello"))
        .sequences(3)
        .to_some(10, 5, DemoMessages().print(2, "some"))
        .hidden(0, DemoMessages().hidden_damage(1, 2, 3))
        .to_one(255, 31, DemoMessages())
        .stats(1, 7, DemoMessages().stat(0, 100))
        .to_reader(2, DemoMessages().zeros(300))
        .bytes();
}

TEST(Blocks, HaveTheirTimesAndAddressees) {
    const Read read = read_in_pieces(example(), {1'000'000});
    EXPECT_EQ(read.end, "");
    ASSERT_EQ(read.blocks.size(), 6U);
    const auto expect = [&](std::size_t i, std::int64_t time, Audience audience) {
        EXPECT_EQ(std::get<0>(read.blocks[i]), time) << i;
        EXPECT_EQ(std::get<3>(read.blocks[i]), audience) << i;
    };
    expect(0, 0, Audience::everyone);
    expect(1, 13, Audience::some);
    expect(2, 13, Audience::nobody);
    expect(3, 268, Audience::one);
    expect(4, 269, Audience::one_s_stats);
    expect(5, 271, Audience::everyone);
    EXPECT_EQ(std::get<4>(read.blocks[3]), 31);
    EXPECT_EQ(std::get<1>(read.blocks[0]), 6U) << "of the content";
}

TEST(Blocks, AreTheSameWhereverTheBytesAreParted) {
    const Bytes demo = example();
    const Read whole = read_in_pieces(demo, {demo.size()});
    EXPECT_EQ(read_in_pieces(demo, {1}), whole);
    for (std::size_t first = 1; first < demo.size(); ++first)
        ASSERT_EQ(read_in_pieces(demo, {first, demo.size()}), whole) << first;
}

TEST(Blocks, ThatAreCutOffAreToldByTheirByte) {
    const Bytes demo = DemoWriter().to_everyone(1, DemoMessages().zeros(4)).bytes();
    for (std::size_t size = 1; size < demo.size(); ++size) {
        const Read read =
            read_in_pieces(Bytes(demo.begin(), demo.begin() + static_cast<std::ptrdiff_t>(size)), {3});
        EXPECT_TRUE(read.blocks.empty());
        EXPECT_THAT(read.end, HasSubstr("byte 0: ")) << size;
        EXPECT_THAT(read.end, HasSubstr("the demo ends")) << size;
    }
}

TEST(Blocks, LargerThanAnyServersAreRefusedBeforeTheyArrive) {
    const Bytes demo = DemoWriter().sequences(1).header(0, 6).number(largest_block + 1, 4).bytes();
    EXPECT_EQ(read_in_pieces(demo, {1}).end, "byte 10: a block of 1048577 bytes, expected at most 1048576");
}

// Damaged or not: blocks and error are the same.
RC_GTEST_PROP(BlocksProperty, PiecesMakeNoDifference, ()) {
    Bytes demo = example();
    const auto damages = *rc::gen::inRange(0, 3);
    for (int i = 0; i < damages; ++i)
        demo[*rc::gen::inRange<std::size_t>(0, demo.size())] =
            static_cast<std::byte>(*rc::gen::inRange(0, 256));
    const auto sizes = *rc::gen::nonEmpty(
        rc::gen::container<std::vector<std::size_t>>(rc::gen::inRange<std::size_t>(1, 40)));
    RC_ASSERT(read_in_pieces(demo, sizes) == read_in_pieces(demo, {demo.size()}));
}

}  // namespace
}  // namespace camdir::quakeworld
