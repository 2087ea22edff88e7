// The container of a multi-view demo: blocks of a server's messages, each with its time and addressees.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "base/error.hpp"
#include "evaluation/quakeworld/cursor.hpp"

namespace camdir::evaluation::quakeworld {

inline constexpr std::size_t max_slots = 32;  // clients of a server

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

// Hands out a demo's blocks; their times do not descend.
class BlockReader {
  public:
    explicit BlockReader(std::span<const std::byte> demo) : cursor_(demo) {}

    // Nothing at the end. Errors name the byte and what was expected; not to be called again after one.
    [[nodiscard]] Result<std::optional<Block>> next();

  private:
    [[nodiscard]] Result<Block> block(std::uint8_t command);

    Cursor cursor_;
    std::int64_t time_ = 0;
};

}  // namespace camdir::evaluation::quakeworld
