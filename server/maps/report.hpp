// The results of a bake, as text and as JSON.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bake/bake.hpp"
#include "base/error.hpp"
#include "scene/scene.hpp"

namespace camdir::maps {

struct BakeReport {
    std::string map;
    std::string source;
    double metres_per_unit = 0.0;
    double d0 = 0.0;         // map units
    std::string parameters;  // bake::to_json
    std::uint64_t vertices = 0;
    std::uint64_t triangles = 0;
    std::uint64_t file_bytes = 0;
    double seconds = 0.0;  // of all stages
    std::vector<bake::StageReport> stages;
};

[[nodiscard]] BakeReport report_of(const scene::Scene& scene, const bake::Baked& baked,
                                   std::uint64_t file_bytes);

[[nodiscard]] nlohmann::ordered_json to_json(const BakeReport& report);

// `certify       12.30 s  150000 triangles, 3 dropped`
[[nodiscard]] std::string line_of(const bake::StageReport& stage);

// `12.30 s`
[[nodiscard]] std::string seconds_text(double seconds);

// The largest memory use of this process so far.
[[nodiscard]] std::uint64_t peak_memory_bytes();

}  // namespace camdir::maps
