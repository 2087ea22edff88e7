// Kills of a recorded match, and whether a camera that followed the killer showed them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "evaluation/camera_path.hpp"
#include "evaluation/match.hpp"
#include "oracle/oracle.hpp"

namespace camdir::evaluation {

struct Kill {
    std::int64_t time = 0;  // ns, the trace's clock
    std::uint32_t killer = 0;
    std::uint32_t victim = 0;
};

// Reads the kills of one player of `trace` by another from a file of its match's events, CSV or CSV.gz, with
// the columns t_ms, event, player (the killer) and other (the victim), or their other names t_ms, kind, actor
// and subject. Rows of another event than `kill`, without killer or victim (empty or 1022, the world), or
// with the same one as both are left out. Errors name the file, the line, the column and what was expected; a
// player whom the trace does not know is one. Memory: at most 16 bytes a kill and twice that while reading.
// Thread-safe.
[[nodiscard]] Result<std::vector<Kill>> read_kills(const std::filesystem::path& path, const Trace& trace);

// The same from bytes in memory; `name` stands for the path in errors.
[[nodiscard]] Result<std::vector<Kill>> parse_kills(std::span<const std::byte> bytes, const std::string& name,
                                                    const Trace& trace);

// The kills of one player by another in the file `events`, or, where that is empty, among the match's own
// events; nothing when it has none.
[[nodiscard]] Result<std::optional<std::vector<Kill>>> kills_of(const RecordedMatch& match,
                                                                const std::filesystem::path& events);

// Metrics::kill_in_view: per cent of the kills that the killer's camera showed, which is that in every frame
// from 0.25 s before the kill to the kill the victim's eye or the centre of their box is somewhere in the
// picture (in_picture, all of it) and the segment from the camera to it is clear. Kills for which the trace
// does not hold all of that time, or lacks one of the two in a frame of it, are not counted; NaN when none
// is. Precondition: one camera a pose.
[[nodiscard]] double kill_in_view(const oracle::Oracle& oracle, double metres_per_unit, const Trace& trace,
                                  std::span<const CameraSample> cameras, std::span<const Kill> kills);

}  // namespace camdir::evaluation
