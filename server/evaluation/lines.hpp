// Lines of a text that may be compressed.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string_view>

#include "base/error.hpp"

namespace camdir::evaluation {

// Receives one line, without its line end.
using LineSink = std::function<Result<void>(std::string_view)>;

// Hands each line of `bytes` (text, or gzip of it) to `sink`, in order, without holding more than one. Fails
// on the sink's first error, on a line longer than 4096 bytes, and beyond the limits of Unpacker.
[[nodiscard]] Result<void> for_each_line(std::span<const std::byte> bytes, const LineSink& sink);

}  // namespace camdir::evaluation
