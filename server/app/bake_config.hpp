// camera-director bake --config: all maps of a configuration.
#pragma once

#include <cstdint>
#include <string>

namespace camdir::app {

struct BakeConfigOptions {
    std::string config;
    std::string report;  // empty: none
    unsigned threads = 0;
    std::uint64_t memory = 0;  // bytes; 0: what is available, half of it for bakes at the same time
    bool force = false;
    bool quiet = false;
};

// Bakes, shows the progress and prints the table; returns the exit code.
[[nodiscard]] int bake_config(const BakeConfigOptions& options);

}  // namespace camdir::app
