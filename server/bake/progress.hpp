// What a bake reports while it runs; injected so that baking knows no terminal.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "freespace/freespace.hpp"

namespace camdir::bake {

// How far a stage is; a total of 0 is unknown. Reported from one thread at a time.
struct Progress {
    std::string_view stage;
    std::uint64_t done;
    std::uint64_t total;
};
using ProgressSink = std::function<void(const Progress&)>;

// A finished stage.
struct StageReport {
    std::string stage;
    double seconds;
    std::vector<freespace::Count> counts;
};
using ReportSink = std::function<void(const StageReport&)>;

// A bake that takes longer is worth an announcement.
inline constexpr double quick_seconds = 60.0;

// What a bake is expected to take; known after its first stage.
struct Forecast {
    double samples = 0.0;      // of the obstacles
    double seconds = 0.0;      // of the whole bake, on a machine like that of tests/bench/all-maps.md
    std::uint64_t memory = 0;  // bytes, at the peak
    // Nominal units: a larger d0 whose bake would take at most quick_seconds. 0 when this one does, or none
    // would.
    double quick_d0 = 0.0;
    std::uint64_t quick_memory = 0;  // bytes that it would take
};
using ForecastSink = std::function<void(const Forecast&)>;

}  // namespace camdir::bake
