#include "quakeworld/blocks.hpp"

#include <string>

#include "quakeworld/cursor.hpp"

namespace camdir::quakeworld {
namespace {

// The low three bits of a block's second byte; the high five are a slot.
enum Command : std::uint8_t {
    client_command = 0,
    to_reader = 1,
    set_sequences = 2,
    to_some = 3,
    to_one = 4,
    stats_of_one = 5,
    to_everyone = 6,
};

constexpr std::size_t size_of_sequences = 8;

struct Header {
    std::uint8_t after = 0;  // ms since the block before
    std::uint8_t slot = 0;
    Audience audience = Audience::everyone;
    bool has_messages = true;
    std::size_t size = 0;  // of the content
};

std::string at(std::size_t offset) {
    return "byte " + std::to_string(offset) + ": ";
}

// Nothing when it is cut off.
Result<std::optional<Header>> read_header(Cursor& cursor) {
    Header header;
    header.after = cursor.u8();
    const std::uint8_t command = cursor.u8();
    if (!cursor.ok()) return std::nullopt;
    header.slot = command >> 3U;
    switch (command & 7U) {
        case client_command:
            return fail(
                "a command of a client, as in a client's own demo (.qwd); expected the blocks of a "
                "multi-view demo (.mvd)");
        case set_sequences:
            header.has_messages = false;
            header.size = size_of_sequences;
            return header;
        case to_reader:
        case to_everyone:
            break;
        case to_some:
            header.audience = cursor.u32() == 0 ? Audience::nobody : Audience::some;
            break;
        case to_one:
            header.audience = Audience::one;
            break;
        case stats_of_one:
            header.audience = Audience::one_s_stats;
            break;
        default:
            return fail("a block of type " + std::to_string(command & 7U) + ", expected 1 to 6");
    }
    header.size = cursor.u32();
    if (!cursor.ok()) return std::nullopt;
    if (header.size > largest_block)
        return fail("a block of " + std::to_string(header.size) + " bytes, expected at most " +
                    std::to_string(largest_block));
    return header;
}

}  // namespace

void BlockReader::append(std::span<const std::byte> bytes) {
    bytes_.erase(bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(begin_));
    offset_ += begin_;
    begin_ = 0;
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
}

Result<std::optional<Block>> BlockReader::next() {
    while (true) {
        Cursor cursor(rest());
        const auto header = read_header(cursor);
        if (!header) return fail(at(offset()) + header.error().message);
        if (!*header || (*header)->size > cursor.left()) return std::nullopt;
        time_ += (*header)->after;
        Block block;
        block.time = time_;
        block.offset = offset() + cursor.offset();
        block.content = cursor.take((*header)->size);
        block.audience = (*header)->audience;
        block.slot = (*header)->slot;
        begin_ += cursor.offset();
        if ((*header)->has_messages) return block;
    }
}

Result<void> BlockReader::expect_end() const {
    Cursor cursor(rest());
    if (cursor.left() == 0) return {};
    const auto header = read_header(cursor);
    if (!header) return fail(at(offset()) + header.error().message);
    if (!*header) return fail(at(offset()) + "the demo ends within the header of a block");
    return fail(at(offset()) + "a block of " + std::to_string((*header)->size) +
                " bytes, but the demo ends after " + std::to_string(cursor.left()));
}

}  // namespace camdir::quakeworld
