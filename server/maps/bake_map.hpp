// Bakes one map of the configuration into its file, for `serve` and for `bake --config`.
#pragma once

#include <cstdint>
#include <optional>
#include <stop_token>
#include <string>

#include "base/error.hpp"
#include "config/config.hpp"
#include "maps/report.hpp"

namespace camdir::maps {

// The bake parameters of a configured map, except the number of threads.
[[nodiscard]] bake::Parameters parameters_of(const config::Map& map);

// Whether a map's file must be baked.
struct Freshness {
    std::string stale;                         // the reason; empty: the file is up to date
    std::string warning;                       // about a file that is used although its source cannot be read
    std::optional<std::uint64_t> source_hash;  // scene::hash_source(); nothing: it cannot be read
};

// For a map with a source. Stale: the file is missing, damaged or of another format version, or was baked
// from other bytes or with other parameters. Fails when neither the file nor the source can be read.
[[nodiscard]] Result<Freshness> examine(const config::Map& map);

// estimate_memory() of the map's source, bytes.
[[nodiscard]] Result<std::uint64_t> memory_needed(const config::Map& map);

struct MapBakeParameters {
    unsigned threads = 0;      // bake::Parameters::threads
    std::uint64_t memory = 0;  // bake::Parameters::memory
    bool force = false;        // bake a fresh map too
};

// Bakes the map's source into its file. Waits while another process or thread bakes the same file; returns
// nothing when the file is fresh afterwards. May be called for different maps at the same time. Fails with
// ErrorCode::interrupted soon after `stop` is requested. After a failure the file is unchanged.
[[nodiscard]] Result<std::optional<BakeReport>> bake_map(const config::Map& map,
                                                         const MapBakeParameters& parameters,
                                                         const bake::ProgressSink& progress,
                                                         const std::stop_token& stop);

}  // namespace camdir::maps
