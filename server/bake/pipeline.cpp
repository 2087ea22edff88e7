#include "bake/pipeline.hpp"

#include <algorithm>
#include <utility>

#include "bake/certify.hpp"
#include "bake/clearance.hpp"
#include "bake/crossing.hpp"
#include "bake/forecast.hpp"
#include "bake/inside.hpp"
#include "bake/medial_axis.hpp"
#include "bake/movers.hpp"
#include "bake/pack.hpp"
#include "bake/recertify.hpp"
#include "bake/reduce.hpp"
#include "bake/sample.hpp"
#include "bake/sample_estimate.hpp"
#include "bake/shell.hpp"
#include "bake/thin.hpp"
#include "bake/triangulate.hpp"
#include "base/round_down.hpp"
#include "freespace/fixed_shots.hpp"

namespace camdir::bake {
namespace {

constexpr double max_loss_of_d0 = 1.5;
// Of the sampling distance: Delaunay edges of at least this length have faces. The paper's 2 gives no face
// that touches an obstacle; but a duct whose balls touch three walls evenly has its samples sqrt(3) radii
// apart, and would close with a radius well above d0. The few faces of shorter edges that touch an obstacle
// are removed by the stage "crossing"; nothing crosses a point.
constexpr double long_edge = 1.7;
// Nominal units: half the width of the narrowest gap between a cloud's points that connects two places.
// Sparse points always leave some narrower gaps in a surface.
constexpr double passage = 5.5;

// Stores the value of a stage's result for the next stage.
template <class T>
Result<void> keep(Result<T> result, T& place) {
    if (!result) return tl::unexpected(std::move(result.error()));
    place = std::move(*result);
    return {};
}

}  // namespace

Pipeline::Pipeline(const scene::Scene& scene, const Parameters& parameters, unsigned threads,
                   const ForecastSink& expected)
    : scene_(scene),
      parameters_(parameters),
      threads_(threads),
      expected_(expected),
      unit_(metres_of_nominal_unit / scene.metres_per_unit),
      d0_(sampling_distance(scene, parameters)),
      obstacles_(scene),
      solids_(scene),
      distance_(d0_),
      samples_(scene.points) {}

Result<void> Pipeline::check_size() const {
    return check_sample_count(scene_, coarsest(), d0_);
}

// Uniform sampling needs no medial axis.
Result<void> Pipeline::medial_axis(Stage& stage) {
    if (parameters_.sampling == Sampling::uniform) return {};
    const Probing probing{2.0 * d0_, SamplingDistance::reach(coarsest()), max_samples};
    auto points = bake::medial_axis(obstacles_, solids_, probing, stage);
    if (!points) return tl::unexpected(std::move(points.error()));
    // So many points mean at least as many samples.
    if (points->size() > max_samples) return too_many_samples(scene_, d0_, static_cast<double>(max_samples));
    distance_ = SamplingDistance(d0_, coarsest(), std::move(*points));
    return {};
}

Result<void> Pipeline::forecast(Stage& /*stage*/) {
    const SampleEstimate estimate = is_cloud()
                                        ? SampleEstimate(static_cast<double>(samples_.size()), d0_)
                                        : SampleEstimate(scene_, solids_, distance_, thinning_distance());
    if (expected_) expected_(bake::forecast(estimate, d0_, unit_, threads_));
    return check_memory(estimate);
}

Result<void> Pipeline::check_memory(const SampleEstimate& estimate) const {
    if (parameters_.memory == 0) return {};
    const Forecast forecast = bake::forecast(estimate, d0_, unit_, threads_);
    return bake::check_memory(forecast, estimate, d0_, unit_, parameters_.memory, scene_.source);
}

Result<void> Pipeline::sample(Stage& stage) {
    return keep(bake::sample(scene_, solids_, distance_, thinning_distance(), stage), samples_);
}

Result<void> Pipeline::thin(Stage& stage) {
    auto done = keep(bake::thin(std::move(samples_), thinning_distance(), stage), samples_);
    if (!done) return done;
    // Until now their number was an estimate.
    return check_memory(SampleEstimate(static_cast<double>(samples_.size()), d0_));
}

Result<void> Pipeline::delaunay(Stage& stage) {
    if (samples_.size() < 4) return fail(scene_.source + ": the obstacles have fewer than 4 samples");
    auto distances = distances_at(samples_, distance_, stage);
    if (!distances) return tl::unexpected(std::move(distances.error()));
    if (may_be_open()) enclose(*distances, stage);
    std::vector<double> min_lengths = std::move(*distances);
    for (double& length : min_lengths)
        length *= long_edge;
    return keep(bake::delaunay(samples_, min_lengths, stage), delaunay_);
}

// Adds the shell's samples with their distances.
void Pipeline::enclose(std::vector<double>& distances, Stage& stage) {
    const Shell shell = shell_around(scene_.bounds, d0_, distance_.coarsest());
    const std::vector<Vec3d> added = shell_samples(scene_.bounds, shell);
    samples_.insert(samples_.end(), added.begin(), added.end());
    distances.resize(samples_.size(), shell.spacing);
    stage.count("shell samples", static_cast<double>(added.size()));
}

Result<void> Pipeline::voronoi(Stage& stage) {
    auto done = keep(voronoi_faces(samples_, delaunay_, scene_.bounds, merge_distance(), stage), faces_);
    delaunay_ = {};
    samples_ = {};
    return done;
}

Result<void> Pipeline::triangulate(Stage& stage) {
    auto done = keep(bake::triangulate(faces_, stage), mesh_);
    faces_ = {};
    return done;
}

Result<void> Pipeline::clearance(Stage& stage) {
    return keep(clearances(mesh_, obstacles_, stage), clearance_);
}

Result<void> Pipeline::crossing(Stage& stage) {
    return remove_crossing(mesh_, clearance_, obstacles_, stage);
}

Result<void> Pipeline::inside(Stage& stage) {
    if (!is_cloud()) return keep_inside(mesh_, clearance_, scene_, solids_, stage);
    return keep_inside_cloud(mesh_, clearance_, free_distance_, offset_radius(), passage * unit_, scene_,
                             stage);
}

Result<void> Pipeline::certify(Stage& stage) {
    return keep(free_distances(mesh_, clearance_, obstacles_, 0.005 * unit_, stage), free_distance_);
}

Result<void> Pipeline::reduce(Stage& stage) {
    if (!(parameters_.loss > 0.0)) return {};
    const double mean = std::max(0.0, mean_free_distance(mesh_, free_distance_) - offset_radius());
    const double loss = std::min(parameters_.loss / 100.0 * mean, max_loss_of_d0 * d0_);
    stage.count("mean free distance", mean);
    stage.count("allowed loss", loss);
    const Reduction reduction{loss, offset_radius(), parameters_.triangles};
    return bake::reduce(mesh_, free_distance_, scene_, obstacles_, reduction, stage);
}

Result<void> Pipeline::pack(Stage& stage) {
    for (float& distance : free_distance_)
        distance = round_down(static_cast<double>(distance) - offset_radius());
    return keep(bake::pack(mesh_, free_distance_, scene_, stage), contents_);
}

Result<void> Pipeline::recertify(Stage& stage) {
    return bake::recertify(contents_, obstacles_, offset_radius(), 0.001 * unit_, scene_.source, stage);
}

Result<void> Pipeline::fixed_shots(Stage& stage) {
    freespace::Contents map = contents_;
    map.metadata.metres_per_unit = static_cast<float>(scene_.metres_per_unit);
    map.metadata.d0 = static_cast<float>(d0_);
    const auto freespace = freespace::Freespace::parse(freespace::encode(map), scene_.source);
    if (!freespace) return tl::unexpected(freespace.error());
    contents_.fixed_shots = freespace::find_fixed_shots(*freespace);
    stage.count("fixed shots", static_cast<double>(contents_.fixed_shots.size()));
    return {};
}

Result<void> Pipeline::movers(Stage& stage) {
    contents_.movers = mover_shapes(scene_, stage);
    return {};
}

}  // namespace camdir::bake
