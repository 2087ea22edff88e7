// What happened in a recorded match: the rows of its table of events.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "evaluation/trace.hpp"

namespace camdir::evaluation {

inline constexpr std::size_t max_events = 1'000'000;

struct TraceEvent {
    std::int64_t time = 0;  // ns, the trace's clock
    std::string kind;       // as the table names it: kill, damage, item, ...
    std::optional<std::uint32_t> actor;
    std::optional<std::uint32_t> subject;
    std::string detail;  // a weapon, an item, hit points
};

// Whether rows of a kind are read; empty: of every kind.
using TakesKind = std::function<bool(std::string_view)>;

// Reads the events of a match, CSV or CSV.gz, with the columns t_ms, event, player, other and perhaps detail,
// or their other names t_ms, kind, actor, subject, value; rows of one time in the table's order. An empty
// player is nobody, as is 1022, the world, where no player has this number. Of a `death` the subject is who
// died, or else the actor, and nobody is the actor. Errors name the file, the line, the column and what was
// expected; a player whom the trace does not know and a time before the last row's are errors, and so are
// more than max_events rows, each of which may take 300 bytes. Of rows of kinds that are not taken only the
// time is looked at. Thread-safe.
[[nodiscard]] Result<std::vector<TraceEvent>> read_events(const std::filesystem::path& path,
                                                          const Trace& trace, const TakesKind& takes = {});

// The same from bytes in memory; `name` stands for the path in errors.
[[nodiscard]] Result<std::vector<TraceEvent>> parse_events(std::span<const std::byte> bytes,
                                                           const std::string& name, const Trace& trace,
                                                           const TakesKind& takes = {});

// The player of the trace that a field of `column` names; nothing when it names nobody.
[[nodiscard]] Result<std::optional<std::uint32_t>> player_in(std::string_view field, const char* column,
                                                             const Trace& trace);

// The time in a field of the column t_ms, ns.
[[nodiscard]] Result<std::int64_t> time_in(std::string_view field);

}  // namespace camdir::evaluation
