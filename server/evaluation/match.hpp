// A recorded match, whatever file holds it.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "evaluation/events.hpp"
#include "evaluation/trace.hpp"

namespace camdir::evaluation {

struct RecordedMatch {
    Trace trace;
    std::optional<std::vector<TraceEvent>> events;  // times do not descend; nothing: the file holds none
    std::string warning;                            // what could not be read; empty: nothing
};

// Reads a table of poses (parse_trace) or a multi-view demo of QuakeWorld, either of them plain or gzip. Of a
// demo, the first match that the server announces, from its begin to its end, or all of it where there is
// none; times are the demo's, players are numbered by the server's order, spectators are left out. In a block
// of the demo the messages behind an unknown or damaged one are skipped, which is the warning, an error where
// more than one block in a hundred has any. Errors name the file, the byte or the line and what was expected.
// Memory: at most 100 times the size of the demo (20 times for one of a game), five times that of the table,
// both unpacked. Thread-safe.
[[nodiscard]] Result<RecordedMatch> read_match(const std::filesystem::path& path);

// The same from bytes in memory; `name` stands for the path in errors.
[[nodiscard]] Result<RecordedMatch> parse_match(std::span<const std::byte> bytes, const std::string& name);

}  // namespace camdir::evaluation
