#include <algorithm>
#include <map>

#include "bench/paper/method.hpp"

namespace camdir::paper {
namespace {

// The part of the work that a stage of the baker belongs to.
std::string part_of(const std::string& stage) {
    static const std::map<std::string, std::string> parts{
        {"medial axis", "sampling"},    {"sample", "sampling"},
        {"weld", "sampling"},           {"delaunay", "Voronoi diagram"},
        {"voronoi", "Voronoi diagram"}, {"certify", "free distance"},
        {"reduce", "reduction"},        {"pack", "packing"}};
    const auto found = parts.find(stage);
    return found == parts.end() ? "inner mesh" : found->second;
}

}  // namespace

Result<Product> run_baker(bool adaptive, const scene::Scene& scene, const Settings& settings) {
    bake::Parameters parameters;
    parameters.d0 = settings.d0;
    parameters.threads = settings.threads;
    parameters.loss = settings.loss;
    parameters.sampling = adaptive ? bake::Sampling::adaptive : bake::Sampling::uniform;

    Figures figures;
    for (const std::string& name : part_names())
        figures.parts.push_back({name, {}});
    Stopwatch stopwatch;
    const auto finished = [&](const bake::StageReport& stage) {
        const std::string name = part_of(stage.stage);
        std::find_if(figures.parts.begin(), figures.parts.end(), [&](const Part& part) {
            return part.name == name;
        })->cost += stopwatch.lap();
        const auto count = [&](const char* what) {
            for (const freespace::Count& c : stage.counts)
                if (c.what == what) return static_cast<std::uint64_t>(c.value);
            return std::uint64_t{0};
        };
        if (stage.stage == "weld") figures.samples = count("samples");
        if (stage.stage == "delaunay") figures.voronoi_vertices = count("cells");
        if (stage.stage == "inside") figures.inner_triangles = count("triangles");
    };
    auto baked = bake::bake(scene, parameters, {}, {}, finished);
    if (!baked) return tl::unexpected(std::move(baked.error()));
    return Product{std::move(baked->contents), std::move(figures)};
}

}  // namespace camdir::paper
