#include "bake/bake.hpp"

#include <tbb/info.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <map>
#include <span>
#include <utility>

#include "bake/parameters_json.hpp"
#include "bake/pipeline.hpp"
#include "bake/stage.hpp"

namespace camdir::bake {
namespace {

using Run = Result<void> (Pipeline::*)(Stage&);
using NamedStage = std::pair<const char*, Run>;

constexpr std::array<NamedStage, 16> of_surfaces{{
    {"medial axis", &Pipeline::medial_axis},
    {"forecast", &Pipeline::forecast},
    {"sample", &Pipeline::sample},
    {"weld", &Pipeline::thin},
    {"delaunay", &Pipeline::delaunay},
    {"voronoi", &Pipeline::voronoi},
    {"triangulate", &Pipeline::triangulate},
    {"clearance", &Pipeline::clearance},
    {"crossing", &Pipeline::crossing},
    {"inside", &Pipeline::inside},
    {"certify", &Pipeline::certify},
    {"reduce", &Pipeline::reduce},
    {"pack", &Pipeline::pack},
    {"recertify", &Pipeline::recertify},
    {"movers", &Pipeline::movers},
    {"fixed shots", &Pipeline::fixed_shots},
}};

// Points are their own samples, and nothing crosses a point. What is connected depends on the free distances.
constexpr std::array<NamedStage, 12> of_points{{
    {"thin", &Pipeline::thin},
    {"forecast", &Pipeline::forecast},
    {"delaunay", &Pipeline::delaunay},
    {"voronoi", &Pipeline::voronoi},
    {"triangulate", &Pipeline::triangulate},
    {"clearance", &Pipeline::clearance},
    {"certify", &Pipeline::certify},
    {"inside", &Pipeline::inside},
    {"reduce", &Pipeline::reduce},
    {"pack", &Pipeline::pack},
    {"recertify", &Pipeline::recertify},
    {"fixed shots", &Pipeline::fixed_shots},
}};

std::span<const NamedStage> stages_of(const Pipeline& pipeline) {
    if (pipeline.is_cloud()) return of_points;
    return of_surfaces;
}

// What the reader skipped, reported like a stage. The reasons name classes of the map, which may be more than
// a MAP.vfs holds counts: those beyond the limit are summed.
StageReport skipped_by_reader(const scene::Scene& scene) {
    constexpr std::size_t max_reasons = 1'000;
    std::map<std::string, double> counts;
    for (const scene::Skipped& skipped : scene.skipped)
        counts[skipped.reason] += static_cast<double>(skipped.count);
    StageReport report{"left out", 0.0, {}};
    double others = 0.0;
    for (const auto& [reason, count] : counts)
        if (report.counts.size() < max_reasons)
            report.counts.push_back({report.stage, reason, count});
        else
            others += count;
    if (others > 0.0) report.counts.push_back({report.stage, "other reasons", others});
    return report;
}

freespace::Metadata describe(const scene::Scene& scene, const Parameters& parameters,
                             const std::vector<StageReport>& reports) {
    freespace::Metadata metadata;
    metadata.map_name = scene.name;
    metadata.source_name = scene.source;
    metadata.source_hash = scene.source_hash;
    metadata.metres_per_unit = static_cast<float>(scene.metres_per_unit);
    metadata.d0 = static_cast<float>(sampling_distance(scene, parameters));
    metadata.parameters = to_json(parameters, scene.options, scene.kind);
    for (const StageReport& report : reports)
        metadata.counts.insert(metadata.counts.end(), report.counts.begin(), report.counts.end());
    return metadata;
}

Result<Baked> run(const scene::Scene& scene, const Parameters& parameters, unsigned threads,
                  const ProgressSink& progress, const std::stop_token& stop, const ReportSink& finished,
                  const ForecastSink& expected) {
    Pipeline pipeline(scene, parameters, threads, expected);
    if (auto bounded = pipeline.check_size(); !bounded) return tl::unexpected(std::move(bounded.error()));
    std::vector<StageReport> reports;
    const auto report = [&](StageReport stage) {
        reports.push_back(std::move(stage));
        if (finished) finished(reports.back());
    };
    if (!scene.skipped.empty()) report(skipped_by_reader(scene));
    for (const auto& [name, run_stage] : stages_of(pipeline)) {
        Stage stage(name, progress, stop);
        if (auto done = (pipeline.*run_stage)(stage); !done) return tl::unexpected(std::move(done.error()));
        report(std::move(stage).finish());
    }
    Baked baked{std::move(pipeline).take(), std::move(reports)};
    baked.contents.metadata = describe(scene, parameters, baked.stages);
    return baked;
}

}  // namespace

Result<Baked> bake(const scene::Scene& scene, const Parameters& parameters, const ProgressSink& progress,
                   std::stop_token stop, const ReportSink& finished, const ForecastSink& expected) {
    if (auto checked = check(parameters); !checked) return tl::unexpected(std::move(checked.error()));
    if (scene.triangles.empty() && scene.points.empty())
        return fail(scene.source + ": the scene has no obstacles");

    const auto cores = static_cast<unsigned>(tbb::info::default_concurrency());
    const unsigned threads = parameters.threads == 0 ? cores : std::min(parameters.threads, cores);
    return tbb::task_arena(static_cast<int>(threads)).execute([&] {
        return run(scene, parameters, threads, progress, stop, finished, expected);
    });
}

}  // namespace camdir::bake
