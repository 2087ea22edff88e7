// What a bake is asked for.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "base/error.hpp"
#include "scene/read_options.hpp"
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

// "adaptive" or "uniform": the name in files, in the configuration and on the command line.
[[nodiscard]] std::string_view name_of(Sampling sampling);
[[nodiscard]] std::optional<Sampling> sampling_named(std::string_view name);

struct Parameters {
    // Sampling distance in units of 0.0254 m: sets which openings exist. min_d0 .. max_d0, or 0: 16, and for
    // a point cloud the points' spacing, as far as it lies within these.
    double d0 = 0.0;
    unsigned threads = 0;  // 0 = one a core, which is also the most. Never changes the result
    // Mesh reduction: how much free distance the centre of a ball may lose, as percent of the mean over the
    // mesh, but at most 3/2 d0: what keeps 3/2 d0 away from the obstacles stays in free space. 0 keeps the
    // whole mesh. 0 .. max_loss. The default keeps tightness above 0.93 on maps of games
    double loss = 16.0;
    std::uint64_t triangles = 0;  // > 0: reduction ends as soon as no more than these are left
    Sampling sampling = Sampling::adaptive;
    double coarsest = 8.0;     // adaptive: no sampling distance is more than this times d0. 1 .. max_coarsest
    std::uint64_t memory = 0;  // > 0: a bake that is expected to take more bytes is refused
};

// What decides the result beside the source, as a JSON object: Metadata::parameters is it, and "kind", what
// the source is.
[[nodiscard]] std::string to_json(const Parameters& parameters, const scene::ReadOptions& options);

// The sampling distance that is used, map units.
[[nodiscard]] double sampling_distance(const scene::Scene& scene, const Parameters& parameters);

// Fails with the first parameter that is out of its range.
[[nodiscard]] Result<void> check(const Parameters& parameters);

}  // namespace camdir::bake
