#include "evaluation/quakeworld/blocks.hpp"

#include <string>

namespace camdir::evaluation::quakeworld {
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

std::string at(std::size_t offset) {
    return "byte " + std::to_string(offset) + ": ";
}

}  // namespace

Result<std::optional<Block>> BlockReader::next() {
    while (cursor_.left() > 0) {
        const std::size_t begin = cursor_.offset();
        time_ += cursor_.u8();
        const std::uint8_t command = cursor_.u8();
        if ((command & 7U) == set_sequences && cursor_.ok()) {
            cursor_.take(8);
            if (cursor_.ok()) continue;
        }
        if (!cursor_.ok()) return fail(at(begin) + "the demo ends within the header of a block");
        auto read = block(command);
        if (!read) return fail(at(begin) + read.error().message);
        return std::optional(*read);
    }
    return std::optional<Block>();
}

Result<Block> BlockReader::block(std::uint8_t command) {
    Block block;
    block.time = time_;
    block.slot = command >> 3U;
    switch (command & 7U) {
        case client_command:
            return fail(
                "a command of a client, as in a client's own demo (.qwd); expected the blocks of a "
                "multi-view demo (.mvd)");
        case to_reader:
        case to_everyone:
            break;
        case to_some:
            block.audience = cursor_.u32() == 0 ? Audience::nobody : Audience::some;
            break;
        case to_one:
            block.audience = Audience::one;
            break;
        case stats_of_one:
            block.audience = Audience::one_s_stats;
            break;
        default:
            return fail("a block of type " + std::to_string(command & 7U) + ", expected 1 to 6");
    }
    const std::uint32_t size = cursor_.u32();
    if (!cursor_.ok()) return fail("the demo ends within the header of a block");
    if (size > cursor_.left())
        return fail("a block of " + std::to_string(size) + " bytes, but the demo ends after " +
                    std::to_string(cursor_.left()));
    block.offset = cursor_.offset();
    block.content = cursor_.take(size);
    return block;
}

}  // namespace camdir::evaluation::quakeworld
