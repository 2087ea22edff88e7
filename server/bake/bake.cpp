#include "bake/bake.hpp"

#include <tbb/info.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <optional>
#include <span>
#include <utility>

#include "bake/certify.hpp"
#include "bake/clearance.hpp"
#include "bake/crossing.hpp"
#include "bake/delaunay.hpp"
#include "bake/geometry/obstacles.hpp"
#include "bake/geometry/solids.hpp"
#include "bake/inside.hpp"
#include "bake/medial_axis.hpp"
#include "bake/medial_mesh.hpp"
#include "bake/pack.hpp"
#include "bake/reduce.hpp"
#include "bake/round_down.hpp"
#include "bake/sample.hpp"
#include "bake/sampling_distance.hpp"
#include "bake/shell.hpp"
#include "bake/stage.hpp"
#include "bake/thin.hpp"
#include "bake/triangulate.hpp"
#include "bake/voronoi.hpp"

namespace camdir::bake {
namespace {

constexpr double default_d0 = 16.0;
constexpr double most_loss = 1.5;  // of d0
// Of the sampling distance: Delaunay edges from this length on have faces. The paper has 2, and so no face
// that touches an obstacle; but a duct whose balls touch three walls evenly has its samples sqrt(3) radii
// apart, and closes with a radius well above d0. Of the faces that the shorter edges add a few touch an
// obstacle, as triangles that crossing.hpp removes; nothing crosses a point.
constexpr double long_edge = 1.7;
// Nominal units: half the width of the narrowest gap between a cloud's points that joins two places. There
// are always some that a hair would pass.
constexpr double passage = 5.5;

// What the stages hand to each other. A stage clears what nobody needs after it.
class Bake {
  public:
    Bake(const scene::Scene& scene, const Parameters& parameters, double unit)
        : scene_(scene),
          parameters_(parameters),
          unit_(unit),
          d0_(sampling_distance(scene, parameters)),
          obstacles_(scene),
          solids_(scene),
          distance_(d0_) {}

    Result<void> run(const ProgressSink& progress, const std::stop_token& stop, const ReportSink& finished);
    [[nodiscard]] Baked take() && { return {std::move(contents_), std::move(reports_)}; }

  private:
    Result<void> medial_axis(Stage& stage);
    Result<void> sample(Stage& stage);
    Result<void> weld(Stage& stage);
    Result<void> delaunay(Stage& stage);
    Result<void> voronoi(Stage& stage);
    Result<void> triangulate(Stage& stage);
    Result<void> clearance(Stage& stage);
    Result<void> crossing(Stage& stage);
    Result<void> inside(Stage& stage);
    Result<void> certify(Stage& stage);
    Result<void> reduce(Stage& stage);
    Result<void> pack(Stage& stage);

    void enclose(std::vector<double>& distances, Stage& stage);

    [[nodiscard]] double coarsest() const {
        return parameters_.sampling == Sampling::uniform ? d0_ : parameters_.coarsest * d0_;
    }
    [[nodiscard]] bool is_cloud() const { return !scene_.points.empty(); }
    // Where volumes are known, the solids close the map.
    [[nodiscard]] bool may_be_open() const { return scene_.brushes.empty(); }
    // Dropped samples must not break the sampling condition: sampling is finer by this distance.
    [[nodiscard]] double weld_distance() const { return is_cloud() ? d0_ / 2.0 : d0_ / 64.0; }
    // Voronoi vertices nearer to each other are one. Half of the triangles lie among such vertices alone, and
    // samples as dense as d0 say nothing of details this small. A cloud's passages are as narrow as its
    // margin leaves them.
    [[nodiscard]] double vertex_weld_distance() const { return is_cloud() ? d0_ / 64.0 : d0_ / 4.0; }
    // What is free around a cloud's points: surface lies up to d0 away from them.
    [[nodiscard]] double margin() const { return is_cloud() ? d0_ : 0.0; }

    const scene::Scene& scene_;
    const Parameters& parameters_;
    double unit_;  // map units in a nominal unit
    double d0_;    // map units
    Obstacles obstacles_;
    Solids solids_;
    SamplingDistance distance_;
    std::vector<Vec3d> samples_;
    Delaunay delaunay_;
    VoronoiFaces faces_;
    MedialMesh mesh_;
    std::vector<double> clearance_;
    std::vector<float> free_distance_;
    freespace::Contents contents_;
    std::vector<StageReport> reports_;
};

// Moves the value of a stage's result to where the next stage finds it.
template <class T>
Result<void> keep(Result<T> result, T& place) {
    if (!result) return tl::unexpected(std::move(result.error()));
    place = std::move(*result);
    return {};
}

// What the reader left out, told like a stage.
StageReport left_out_of(const scene::Scene& scene) {
    std::map<std::string, double> counts;
    for (const scene::LeftOut& left_out : scene.left_out)
        counts[left_out.reason] += static_cast<double>(left_out.count);
    StageReport report{"left out", 0.0, {}};
    for (const auto& [reason, count] : counts)
        report.counts.push_back({report.stage, reason, count});
    return report;
}

Result<void> Bake::run(const ProgressSink& progress, const std::stop_token& stop,
                       const ReportSink& finished) {
    using Run = Result<void> (Bake::*)(Stage&);
    using Named = std::pair<const char*, Run>;
    static constexpr std::array<Named, 12> of_surfaces{{
        {"medial axis", &Bake::medial_axis},
        {"sample", &Bake::sample},
        {"weld", &Bake::weld},
        {"delaunay", &Bake::delaunay},
        {"voronoi", &Bake::voronoi},
        {"triangulate", &Bake::triangulate},
        {"clearance", &Bake::clearance},
        {"crossing", &Bake::crossing},
        {"inside", &Bake::inside},
        {"certify", &Bake::certify},
        {"reduce", &Bake::reduce},
        {"pack", &Bake::pack},
    }};
    // Points sample themselves, and nothing crosses a point. What is connected depends on the margin.
    static constexpr std::array<Named, 9> of_points{{
        {"thin", &Bake::weld},
        {"delaunay", &Bake::delaunay},
        {"voronoi", &Bake::voronoi},
        {"triangulate", &Bake::triangulate},
        {"clearance", &Bake::clearance},
        {"certify", &Bake::certify},
        {"inside", &Bake::inside},
        {"reduce", &Bake::reduce},
        {"pack", &Bake::pack},
    }};
    if (auto bounded = check_sample_count(scene_, coarsest(), d0_); !bounded) return bounded;
    samples_ = scene_.points;
    if (!scene_.left_out.empty()) {
        reports_.push_back(left_out_of(scene_));
        if (finished) finished(reports_.back());
    }
    for (const auto& [name, stage_of] : is_cloud() ? std::span<const Named>(of_points) : of_surfaces) {
        Stage stage(name, progress, stop);
        if (auto done = (this->*stage_of)(stage); !done) return done;
        reports_.push_back(std::move(stage).finish());
        if (finished) finished(reports_.back());
    }
    return {};
}

// Uniform sampling asks no medial axis.
Result<void> Bake::medial_axis(Stage& stage) {
    if (parameters_.sampling == Sampling::uniform) return {};
    const Probing probing{2.0 * d0_, SamplingDistance::reach(coarsest()), max_samples};
    auto points = bake::medial_axis(obstacles_, solids_, probing, stage);
    if (!points) return tl::unexpected(std::move(points.error()));
    // Where the obstacles are that near to each other the samples are as dense.
    if (points->size() > max_samples) return too_many_samples(scene_, d0_, static_cast<double>(max_samples));
    distance_ = SamplingDistance(d0_, coarsest(), std::move(*points));
    return {};
}

Result<void> Bake::sample(Stage& stage) {
    return keep(bake::sample(scene_, solids_, distance_, weld_distance(), stage), samples_);
}

Result<void> Bake::weld(Stage& stage) {
    return keep(bake::weld(std::move(samples_), weld_distance(), stage), samples_);
}

Result<void> Bake::delaunay(Stage& stage) {
    if (samples_.size() < 4) return fail(scene_.source + ": the obstacles have fewer than 4 samples");
    auto distances = distances_at(samples_, distance_, stage);
    if (!distances) return tl::unexpected(std::move(distances.error()));
    if (may_be_open()) enclose(*distances, stage);
    std::vector<double> min_lengths = std::move(*distances);
    for (double& length : min_lengths)
        length *= long_edge;
    return keep(bake::delaunay(samples_, min_lengths, stage), delaunay_);
}

// Adds the shell's samples, and their distances.
void Bake::enclose(std::vector<double>& distances, Stage& stage) {
    const Shell shell = shell_around(scene_.bounds, d0_, distance_.coarsest());
    const std::vector<Vec3d> added = shell_samples(scene_.bounds, shell);
    samples_.insert(samples_.end(), added.begin(), added.end());
    distances.resize(samples_.size(), shell.spacing);
    stage.count("shell samples", static_cast<double>(added.size()));
}

Result<void> Bake::voronoi(Stage& stage) {
    auto done =
        keep(voronoi_faces(samples_, delaunay_, scene_.bounds, vertex_weld_distance(), stage), faces_);
    delaunay_ = {};
    samples_ = {};
    return done;
}

Result<void> Bake::triangulate(Stage& stage) {
    auto done = keep(bake::triangulate(faces_, stage), mesh_);
    faces_ = {};
    return done;
}

Result<void> Bake::clearance(Stage& stage) {
    return keep(clearances(mesh_, obstacles_, stage), clearance_);
}

Result<void> Bake::crossing(Stage& stage) {
    return remove_crossing(mesh_, clearance_, obstacles_, stage);
}

Result<void> Bake::inside(Stage& stage) {
    if (!is_cloud()) return keep_inside(mesh_, clearance_, scene_, solids_, stage);
    return keep_inside_cloud(mesh_, clearance_, free_distance_, margin(), passage * unit_, scene_, stage);
}

Result<void> Bake::certify(Stage& stage) {
    return keep(free_distances(mesh_, clearance_, obstacles_, 0.005 * unit_, stage), free_distance_);
}

Result<void> Bake::reduce(Stage& stage) {
    if (!(parameters_.loss > 0.0)) return {};
    const double mean = std::max(0.0, mean_free_distance(mesh_, free_distance_) - margin());
    const double loss = std::min(parameters_.loss / 100.0 * mean, most_loss * d0_);
    stage.count("mean free distance", mean);
    stage.count("allowed loss", loss);
    const Reduction reduction{loss, margin(), parameters_.triangles};
    return bake::reduce(mesh_, free_distance_, scene_, obstacles_, reduction, stage);
}

Result<void> Bake::pack(Stage& stage) {
    for (float& distance : free_distance_)
        distance = round_down(static_cast<double>(distance) - margin());
    return keep(bake::pack(mesh_, free_distance_, scene_, stage), contents_);
}

std::string number(double value) {
    std::array<char, 32> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value);
    return {text.data(), end.ptr};
}

std::string triple(const Vec3d& p) {
    return "[" + number(p.x()) + ", " + number(p.y()) + ", " + number(p.z()) + "]";
}

// As far as it was given.
std::string json_of(const scene::ReadOptions& options) {
    std::string json;
    if (options.metres_per_unit) json += ", \"metres_per_unit\": " + number(*options.metres_per_unit);
    if (options.up) json += *options.up == scene::UpAxis::y ? ", \"up\": \"y\"" : ", \"up\": \"z\"";
    if (options.origin != Vec3d::Zero()) json += ", \"origin\": " + triple(options.origin);
    if (options.seeds.empty()) return json;
    std::string seeds;
    for (const Vec3d& seed : options.seeds)
        seeds += (seeds.empty() ? "" : ", ") + triple(seed);
    return json + ", \"seeds\": [" + seeds + "]";
}

freespace::Metadata describe(const scene::Scene& scene, const Parameters& parameters, double d0,
                             const std::vector<StageReport>& reports) {
    freespace::Metadata metadata;
    metadata.map_name = scene.name;
    metadata.source_name = scene.source;
    metadata.source_hash = scene.source_hash;
    metadata.metres_per_unit = static_cast<float>(scene.metres_per_unit);
    metadata.d0 = static_cast<float>(d0);
    metadata.parameters = to_json(parameters, scene.options);
    metadata.parameters.insert(1, "\"kind\": \"" + scene.kind + "\", ");
    for (const StageReport& report : reports)
        metadata.counts.insert(metadata.counts.end(), report.counts.begin(), report.counts.end());
    return metadata;
}

}  // namespace

std::string to_json(const Parameters& parameters, const scene::ReadOptions& options) {
    return "{\"d0\": " + number(parameters.d0) + ", \"sampling\": \"" +
           std::string(name_of(parameters.sampling)) + "\", \"coarsest\": " + number(parameters.coarsest) +
           ", \"loss\": " + number(parameters.loss) +
           ", \"triangles\": " + std::to_string(parameters.triangles) + json_of(options) + "}";
}

std::string_view name_of(Sampling sampling) {
    return sampling == Sampling::adaptive ? "adaptive" : "uniform";
}

std::optional<Sampling> sampling_named(std::string_view name) {
    for (const Sampling sampling : {Sampling::adaptive, Sampling::uniform})
        if (name == name_of(sampling)) return sampling;
    return std::nullopt;
}

double sampling_distance(const scene::Scene& scene, const Parameters& parameters) {
    const double unit = scene::metres_of_nominal_unit / scene.metres_per_unit;
    if (parameters.d0 > 0.0) return parameters.d0 * unit;
    if (scene.points.empty()) return default_d0 * unit;
    return std::clamp(scene.point_spacing, min_d0 * unit, max_d0 * unit);
}

Result<Baked> bake(const scene::Scene& scene, const Parameters& parameters, const ProgressSink& progress,
                   std::stop_token stop, const ReportSink& finished) {
    if (parameters.d0 != 0.0 && !(parameters.d0 >= min_d0 && parameters.d0 <= max_d0))
        return fail("d0 = " + number(parameters.d0) + ": expected a distance from 2 to 256 units");
    if (!(parameters.coarsest >= 1.0 && parameters.coarsest <= max_coarsest))
        return fail("coarsest = " + number(parameters.coarsest) + ": expected a number from 1 to 64");
    if (!(parameters.loss >= 0.0 && parameters.loss <= max_loss))
        return fail("loss = " + number(parameters.loss) + ": expected a percentage from 0 to 100");
    if (scene.triangles.empty() && scene.points.empty())
        return fail(scene.source + ": the scene has no obstacles");

    const double unit = scene::metres_of_nominal_unit / scene.metres_per_unit;
    const double d0 = sampling_distance(scene, parameters);
    const auto cores = static_cast<unsigned>(tbb::info::default_concurrency());
    const unsigned threads = parameters.threads == 0 ? cores : std::min(parameters.threads, cores);
    return tbb::task_arena(static_cast<int>(threads)).execute([&]() -> Result<Baked> {
        Bake bake(scene, parameters, unit);
        if (auto done = bake.run(progress, stop, finished); !done)
            return tl::unexpected(std::move(done.error()));
        Baked baked = std::move(bake).take();
        baked.contents.metadata = describe(scene, parameters, d0, baked.stages);
        return baked;
    });
}

}  // namespace camdir::bake
