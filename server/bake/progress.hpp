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

}  // namespace camdir::bake
