// Baking a map of the configuration into its file: what `serve` does at start and `bake --config` for all.
#pragma once

#include <optional>
#include <stop_token>
#include <string>

#include "base/error.hpp"
#include "config/config.hpp"
#include "maps/report.hpp"

namespace camdir::maps {

// The configured map's, but for the number of threads.
[[nodiscard]] bake::Parameters parameters_of(const config::Map& map);

// Whether a map's file has to be baked.
struct Freshness {
    std::string stale;    // why; empty: the file holds the map as it is configured
    std::string warning;  // of a file that is used although its source cannot be read
};

// For a map with a source: stale when the file is missing, damaged or of another format version, or was
// baked from other bytes or with other parameters. Fails when neither file nor source can be read.
[[nodiscard]] Result<Freshness> examine(const config::Map& map);

// Of a bake of the map's source, in bytes, from above: estimate_memory().
[[nodiscard]] Result<std::uint64_t> memory_needed(const config::Map& map);

struct MapBakeParameters {
    unsigned threads = 0;  // bake::Parameters::threads
    bool force = false;    // bake also what is fresh
};

// Bakes the map's source into its file. Waits while another process or thread bakes the same file; nothing
// when the file is fresh by then. Safe to call for different maps at once. Fails with ErrorCode::interrupted
// soon after `stop` is requested; the file is then, and after any failure, as it was before.
[[nodiscard]] Result<std::optional<BakeReport>> bake_map(const config::Map& map,
                                                         const MapBakeParameters& parameters,
                                                         const bake::ProgressSink& progress,
                                                         const std::stop_token& stop);

}  // namespace camdir::maps
