// The stages of one bake and what they hand to each other.
#pragma once

#include <utility>
#include <vector>

#include "bake/delaunay.hpp"
#include "bake/geometry/obstacles.hpp"
#include "bake/geometry/solids.hpp"
#include "bake/medial_mesh.hpp"
#include "bake/parameters.hpp"
#include "bake/progress.hpp"
#include "bake/sampling_distance.hpp"
#include "bake/stage.hpp"
#include "bake/voronoi.hpp"
#include "base/error.hpp"
#include "freespace/freespace.hpp"
#include "scene/scene.hpp"

namespace camdir::bake {

class SampleEstimate;

// Each member function with a Stage is one stage: it reads the results of earlier stages and clears those
// that later ones do not need.
class Pipeline {
  public:
    // All that is passed must outlive it. `threads` is how many the stages run on.
    Pipeline(const scene::Scene& scene, const Parameters& parameters, unsigned threads,
             const ForecastSink& expected);

    // Before the first stage: fails when the samples would be too many for memory.
    [[nodiscard]] Result<void> check_size() const;

    [[nodiscard]] Result<void> medial_axis(Stage& stage);
    // Reports what the other stages are going to take; fails when that is more than the bake may have.
    [[nodiscard]] Result<void> forecast(Stage& stage);
    [[nodiscard]] Result<void> sample(Stage& stage);
    [[nodiscard]] Result<void> thin(Stage& stage);
    [[nodiscard]] Result<void> delaunay(Stage& stage);
    [[nodiscard]] Result<void> voronoi(Stage& stage);
    [[nodiscard]] Result<void> triangulate(Stage& stage);
    [[nodiscard]] Result<void> clearance(Stage& stage);
    [[nodiscard]] Result<void> crossing(Stage& stage);
    [[nodiscard]] Result<void> inside(Stage& stage);
    [[nodiscard]] Result<void> certify(Stage& stage);
    [[nodiscard]] Result<void> reduce(Stage& stage);
    [[nodiscard]] Result<void> pack(Stage& stage);
    [[nodiscard]] Result<void> recertify(Stage& stage);
    [[nodiscard]] Result<void> fixed_shots(Stage& stage);
    [[nodiscard]] Result<void> movers(Stage& stage);

    [[nodiscard]] bool is_cloud() const { return !scene_.points.empty(); }
    // After the last stage. Leaves metadata to the caller.
    [[nodiscard]] freespace::Contents take() && { return std::move(contents_); }

  private:
    void enclose(std::vector<double>& distances, Stage& stage);
    // Fails when a bake of so many samples takes more memory than it may have.
    [[nodiscard]] Result<void> check_memory(const SampleEstimate& estimate) const;

    [[nodiscard]] double coarsest() const {
        return parameters_.sampling == Sampling::uniform ? d0_ : parameters_.coarsest * d0_;
    }
    // Where volumes are known, the solids close the map.
    [[nodiscard]] bool may_be_open() const { return scene_.brushes.empty(); }
    // Sampling is finer by this distance, so that dropped samples do not break the sampling condition.
    [[nodiscard]] double thinning_distance() const { return is_cloud() ? d0_ / 2.0 : d0_ / 64.0; }
    // Voronoi vertices nearer to each other are merged: half of the triangles join only such vertices, and
    // samples as dense as d0 do not resolve details this small. Less for a cloud, whose passages are as
    // narrow as its offset radius leaves them.
    [[nodiscard]] double merge_distance() const { return is_cloud() ? d0_ / 64.0 : d0_ / 4.0; }
    // Balls of this radius around a cloud's points are not free: surface lies up to d0 away from the points.
    [[nodiscard]] double offset_radius() const { return is_cloud() ? d0_ : 0.0; }

    const scene::Scene& scene_;
    const Parameters& parameters_;
    unsigned threads_;
    const ForecastSink& expected_;
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
};

}  // namespace camdir::bake
