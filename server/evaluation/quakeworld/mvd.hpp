// Multi-view demos of QuakeWorld (.mvd): what a server such as mvdsv records of a match, with every player in
// every frame.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "evaluation/match.hpp"

namespace camdir::evaluation::quakeworld {

// Whether `content` may be a demo, told by its first byte, which is no text.
[[nodiscard]] bool is_demo(std::span<const std::byte> content);

// Reads a demo, plain or gzip; `name` stands for its path in errors. See read_match().
[[nodiscard]] Result<RecordedMatch> parse_demo(std::span<const std::byte> bytes, const std::string& name);

}  // namespace camdir::evaluation::quakeworld
