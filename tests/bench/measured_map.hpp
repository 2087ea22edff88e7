// One map baked, verified and measured.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "map_sources.hpp"

namespace camdir::bench {

struct MeasureParameters {
    std::filesystem::path programs;         // folder with camera-director and bench-delaunay
    std::filesystem::path work;             // where MAP.vfs is kept
    std::vector<std::string> bake_options;  // further options of the bake
    std::uint64_t balls = 0;
    std::uint64_t points = 100'000;
    bool check_threads = false;
};

// NaN or absent: not measured.
struct BakeFigures {
    double seconds = 0.0;      // of the whole command
    double cpu_seconds = 0.0;  // of all its threads
    double yardsticks = 0.0;   // seconds as a multiple of those of bench-delaunay, run just before
    double samples = 0.0;
    double unreduced_triangles = 0.0;
    double triangles = 0.0;
    double megabytes = 0.0;       // of the file
    double peak_megabytes = 0.0;  // of memory
    double first_query_ms = 0.0;  // opening and checking the file, one distance query
};

struct VerifyFigures {
    double unsafe = 0.0;
    double balls = 0.0;  // tested
    double overestimates = 0.0;
    double coverage = 0.0;           // percent of all
    double coverage_above_d0 = 0.0;  // percent at clearance > d0
    double tightness = 0.0;
    double spawn_points = 0.0;
    double uncovered_spawn_points = 0.0;
    double unjoined_spawn_points = 0.0;  // not in the component that holds most of them
    double components = 0.0;             // of the roadmap
};

struct MeasuredMap {
    std::string name;
    std::optional<BakeFigures> bake;
    std::optional<VerifyFigures> verify;
    std::vector<std::string> failures;  // steps that failed, limits that do not hold
};

// Throws std::runtime_error when a program of the project cannot be run or its output cannot be read.
[[nodiscard]] MeasuredMap measure(const MapSource& map, const MeasureParameters& parameters);

}  // namespace camdir::bench
