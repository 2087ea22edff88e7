// Baking: Scene -> VFS-rep. The paper's section 4.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "freespace/freespace.hpp"
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
    double coarsest = 8.0;  // adaptive: no sampling distance is more than this times d0. 1 .. max_coarsest
};

// What decides the result beside the source, as a JSON object: Metadata::parameters is it, and "kind", what
// the source is.
[[nodiscard]] std::string to_json(const Parameters& parameters, const scene::ReadOptions& options);

// How far a stage is; injected so that baking knows no terminal. Called from one thread at a time.
struct Progress {
    std::string_view stage;
    std::uint64_t done;
    std::uint64_t total;
};
using ProgressSink = std::function<void(const Progress&)>;

struct StageReport {
    std::string stage;
    double seconds;
    std::vector<freespace::Count> counts;
};
using ReportSink = std::function<void(const StageReport&)>;

struct Baked {
    freespace::Contents contents;
    std::vector<StageReport> stages;
};

// The sampling distance that is used, map units.
[[nodiscard]] double sampling_distance(const scene::Scene& scene, const Parameters& parameters);

// Runs all stages; tells `finished`, on the calling thread, about each when it is done. May be called by
// several threads at once. Fails with ErrorCode::interrupted soon after `stop` is requested, and with
// `failed` when a parameter is out of its range, or when the scene has no obstacles, no spawn point in free
// space, or too many samples for memory.
[[nodiscard]] Result<Baked> bake(const scene::Scene& scene, const Parameters& parameters,
                                 const ProgressSink& progress, std::stop_token stop,
                                 const ReportSink& finished = {});

}  // namespace camdir::bake
