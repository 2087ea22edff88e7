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

// Hands each line of `bytes` (text, or gzip with any number of members) to `sink`, in order, without holding
// more than one. Fails on the sink's first error, on a damaged or cut off compressed stream, on a line longer
// than 4096 bytes, and on compressed text beyond 1 MiB plus 200 times its compressed size or beyond 1 GiB.
[[nodiscard]] Result<void> for_each_line(std::span<const std::byte> bytes, const LineSink& sink);

}  // namespace camdir::evaluation
