// Baking several maps at once.
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

enum class MapState {
    fresh,        // the file held the map as configured, or another process made it so meanwhile
    baked,        // now
    failed,       // the file is as it was
    interrupted,  // not baked, or not to the end; the file is as it was
};

[[nodiscard]] std::string_view name_of(MapState state);

struct MapOutcome {
    std::string map;
    MapState state = MapState::interrupted;
    std::string reason;  // why it was baked or failed; of a fresh one what is odd about it
    double seconds = 0.0;
    // Of the file; 0 when failed or interrupted.
    std::uint64_t samples = 0;
    std::uint64_t triangles = 0;
    std::uint64_t file_bytes = 0;
    std::optional<BakeReport> report;  // of a baked one
};

struct BatchParameters {
    unsigned threads = 0;      // of all bakes together; 0 = one a core, which is also the most
    std::uint64_t memory = 0;  // bytes that bakes at once may take by their estimates
    bool force = false;        // bake fresh ones too
};

// Both are called from one thread at a time.
struct BatchSink {
    std::function<void(std::size_t to_bake)> examined;
    std::function<void(const std::string& map, const bake::Progress&)> progress;
    std::function<void(const MapOutcome&)> finished;  // in the order in which they end
};

// Bakes those of the maps (each with a source) that are not fresh, as many at once as memory and threads
// allow. One that fails does not stop the others. Outcomes are in the order of the maps.
[[nodiscard]] std::vector<MapOutcome> bake_maps(const std::vector<config::Map>& maps,
                                                const BatchParameters& parameters, const BatchSink& sink,
                                                const std::stop_token& stop);

}  // namespace camdir::maps
