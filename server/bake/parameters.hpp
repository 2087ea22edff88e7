// What a bake is asked for.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "base/error.hpp"
#include "scene/scene.hpp"

namespace camdir::bake {

inline constexpr double min_d0 = 2.0;
inline constexpr double max_d0 = 256.0;
inline constexpr double max_loss = 100.0;
inline constexpr double max_coarsest = 64.0;

enum class Sampling : std::uint8_t {
    adaptive,  // dense where the free space is narrow, sparse where it is wide
    uniform,   // the same distance everywhere
};

// "adaptive" or "uniform": the name in files, the configuration and on the command line.
[[nodiscard]] std::string_view name_of(Sampling sampling);
[[nodiscard]] std::optional<Sampling> sampling_named(std::string_view name);

struct Parameters {
    // Sampling distance in nominal units of 0.0254 m: decides which openings exist. min_d0 .. max_d0, or 0
    // for the default: 16, for a point cloud the points' spacing clamped to that range.
    double d0 = 0.0;
    unsigned threads = 0;  // 0 = one per core, which is also the limit. Never changes the result
    // Mesh reduction: how much free distance the centre of a ball may lose, as percent of the mean over the
    // mesh, at most 3/2 d0: points at least that far from the obstacles stay in free space. 0 .. max_loss; 0
    // turns reduction off. The default keeps tightness above 0.93 on game maps.
    double loss = 16.0;
    std::uint64_t triangles = 0;  // > 0: reduction ends when at most this many are left
    Sampling sampling = Sampling::adaptive;
    double coarsest = 8.0;     // adaptive: limit of the sampling distance, times d0. 1 .. max_coarsest
    std::uint64_t memory = 0;  // > 0: a bake that is expected to take more bytes is refused
};

// The sampling distance that is used, map units.
[[nodiscard]] double sampling_distance(const scene::Scene& scene, const Parameters& parameters);

// Fails with the first parameter that is out of its range.
[[nodiscard]] Result<void> check(const Parameters& parameters);

}  // namespace camdir::bake
