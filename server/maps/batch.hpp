// Bakes several maps at the same time.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "config/config.hpp"
#include "maps/report.hpp"

namespace camdir::maps {

enum class BakeStatus {
    fresh,        // the file was up to date, or another process baked it in the meantime
    baked,        // by this batch
    failed,       // the file is unchanged
    interrupted,  // not baked or not finished; the file is unchanged
};

[[nodiscard]] std::string_view name_of(BakeStatus status);

struct BakeOutcome {
    std::string map;
    BakeStatus status = BakeStatus::interrupted;
    std::string reason;  // why it was baked or failed; of a fresh one a warning
    double seconds = 0.0;
    // Of the file; 0 when failed or interrupted.
    std::uint64_t samples = 0;
    std::uint64_t triangles = 0;
    std::uint64_t file_bytes = 0;
    std::optional<BakeReport> report;  // of a baked one
};

struct BatchParameters {
    unsigned threads = 0;       // of all bakes together; 0: one per core, which is also the maximum
    std::uint64_t memory = 0;   // bytes for the estimates of the bakes that run at the same time
    std::uint64_t largest = 0;  // bytes of one bake: a map that is expected to need more fails
    bool force = false;         // bake fresh maps too
};

// Receives the progress. Called from one thread at a time.
struct BatchSink {
    std::function<void(std::size_t to_bake)> examined;
    std::function<void(const std::string& map, const bake::Progress&)> progress;
    std::function<void(const BakeOutcome&)> finished;  // in the order in which they finish
};

// Bakes the maps that are not fresh, as many at the same time as memory and threads allow. Each map has a
// source. A map that fails does not stop the others. Outcomes are in the order of the maps.
[[nodiscard]] std::vector<BakeOutcome> bake_maps(const std::vector<config::Map>& maps,
                                                 const BatchParameters& parameters, const BatchSink& sink,
                                                 const std::stop_token& stop);

}  // namespace camdir::maps
