// camera-director bake --config: all maps of a configuration.
#pragma once

#include <cstdint>
#include <string>

namespace camdir::app {

struct BakeConfigOptions {
    std::string config;
    std::string report;  // empty: none
    unsigned threads = 0;
    std::uint64_t memory_mib = 0;  // 0: default_memory
    bool force = false;
    bool quiet = false;
};

// Half of the machine's memory, or of what its control groups may take where that is less; bytes.
[[nodiscard]] std::uint64_t default_memory();

// Bakes, tells how it goes and prints the table; the exit code.
[[nodiscard]] int bake_config(const BakeConfigOptions& options);

}  // namespace camdir::app
