// The container of a multi-view demo: blocks of a server's messages, each with its time and addressees. A
// file (.mvd) is one, and so is the stream of a QTV server.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "base/error.hpp"
#include "base/file.hpp"

namespace camdir::quakeworld {

inline constexpr std::size_t max_slots = 32;             // clients of a server
inline constexpr std::size_t largest_block = 1U << 20U;  // bytes of content: servers send 8 kB at most

enum class Audience {
    everyone,
    some,         // named by a bit mask, which no reader needs
    one,          // Block::slot
    one_s_stats,  // stats of Block::slot, for those who watch that player
    nobody,       // what is hidden from clients: not messages, but sections
};

struct Block {
    std::int64_t time = 0;   // ms since the demo's begin
    std::size_t offset = 0;  // of its content in the demo
    std::span<const std::byte> content;
    Audience audience = Audience::everyone;
    std::uint8_t slot = 0;
};

// Hands out a demo's blocks, whose times do not descend, as its bytes arrive. Holds what has been appended
// and not handed out.
class BlockReader {
  public:
    // The demo's next bytes, which may end anywhere. The contents of earlier blocks are invalid now.
    void append(std::span<const std::byte> bytes);

    // Nothing while the next block is not complete. Errors name the byte and what was expected; not to be
    // called again after one.
    [[nodiscard]] Result<std::optional<Block>> next();

    // When next() has nothing: whether the demo may end here. The error names the byte of the cut off block.
    [[nodiscard]] Result<void> expect_end() const;

  private:
    [[nodiscard]] std::span<const std::byte> rest() const { return std::span(bytes_).subspan(begin_); }
    [[nodiscard]] std::size_t offset() const { return offset_ + begin_; }

    Bytes bytes_;
    std::size_t begin_ = 0;   // in bytes_: of what has not been handed out
    std::size_t offset_ = 0;  // of bytes_ in the demo
    std::int64_t time_ = 0;
};

}  // namespace camdir::quakeworld
