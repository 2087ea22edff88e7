#include <tbb/task_arena.h>

#include <algorithm>

#include "bake/certify.hpp"
#include "bake/clearance.hpp"
#include "bake/crossing.hpp"
#include "bake/inside.hpp"
#include "bake/pack.hpp"
#include "bake/sample.hpp"
#include "bake/thin.hpp"
#include "bake/triangulate.hpp"
#include "bench/paper/constant_distance.hpp"
#include "bench/paper/method.hpp"
#include "bench/paper/sampling.hpp"
#include "bench/paper/vertex_elimination.hpp"
#include "bench/paper/voronoi.hpp"

namespace camdir::paper {
namespace {

std::uint64_t used_vertices(const bake::MedialMesh& mesh) {
    std::vector<char> used(mesh.vertices.size());
    for (const auto& [a, b, c] : mesh.triangles)
        used[a] = used[b] = used[c] = 1;
    return static_cast<std::uint64_t>(std::count(used.begin(), used.end(), 1));
}

std::uint64_t distinct(std::vector<std::uint32_t> ids) {  // ascending
    return static_cast<std::uint64_t>(std::unique(ids.begin(), ids.end()) - ids.begin());
}

class Run {
  public:
    Run(const Pipeline& pipeline, const scene::Scene& scene, const Settings& settings)
        : pipeline_(pipeline),
          scene_(scene),
          settings_(settings),
          unit_(metres_of_nominal_unit / scene.metres_per_unit),
          d0_(settings.d0 * unit_),
          obstacles_(scene),
          solids_(scene) {}

    Result<Product> run() {
        using Step = Result<void> (Run::*)();
        constexpr std::array<Step, 6> steps{&Run::sample,  &Run::voronoi, &Run::inner_mesh,
                                            &Run::measure, &Run::reduce,  &Run::pack};
        Stopwatch stopwatch;
        for (std::size_t i = 0; i < steps.size(); ++i) {
            if (auto done = (this->*steps[i])(); !done) return tl::unexpected(std::move(done.error()));
            product_.figures.parts.push_back({part_names()[i], stopwatch.lap()});
        }
        return std::move(product_);
    }

  private:
    Result<void> sample();
    Result<void> voronoi();
    Result<void> inner_mesh();
    Result<void> measure();
    Result<void> reduce();
    Result<void> pack();

    const Pipeline& pipeline_;
    const scene::Scene& scene_;
    const Settings& settings_;
    double unit_;  // map units in 0.0254 m
    double d0_;    // map units
    bake::Stage stage_{"bench", {}, {}};
    bake::Obstacles obstacles_;
    bake::Solids solids_;
    std::vector<Vec3d> samples_;
    Faces faces_;
    bake::MedialMesh mesh_;
    std::vector<double> clearance_;
    std::vector<float> free_distance_;
    Product product_;
};

template <class T>
Result<void> keep(Result<T> result, T& place) {
    if (!result) return tl::unexpected(std::move(result.error()));
    place = std::move(*result);
    return {};
}

Result<void> Run::sample() {
    Result<void> done;
    if (pipeline_.sampling == SamplingRule::edges) {
        done = keep(paper::sample(scene_, d0_), samples_);
    } else {
        const double slack = d0_ / 64.0;  // what welding may take
        done = keep(bake::sample(scene_, solids_, bake::SamplingDistance(d0_), slack, stage_), samples_);
        if (done) done = keep(bake::thin(std::move(samples_), slack, stage_), samples_);
    }
    product_.figures.samples = samples_.size();
    return done;
}

Result<void> Run::voronoi() {
    auto done = keep(pipeline_.engine == Engine::qhull
                         ? voronoi_by_qhull(samples_, 2.0 * d0_, scene_.bounds)
                         : voronoi_by_cgal(samples_, 2.0 * d0_, scene_.bounds, 0.01 * unit_),
                     faces_);
    product_.figures.voronoi_vertices = faces_.voronoi_vertices;
    return done;
}

// What the paper keeps of the faces, by the baker's definition of inside. Triangles that
// cross obstacles, which no free distance makes safe, are removed only with certified distances: the paper
// trusts its sampling.
Result<void> Run::inner_mesh() {
    auto done = keep(bake::triangulate(faces_.faces, stage_), mesh_);
    if (done) done = keep(bake::clearances(mesh_, obstacles_, stage_), clearance_);
    if (done && pipeline_.free_distance == FreeDistance::certified)
        done = bake::remove_crossing(mesh_, clearance_, obstacles_, stage_);
    if (done) done = bake::keep_inside(mesh_, clearance_, scene_, solids_, stage_);
    return done;
}

Result<void> Run::measure() {
    const std::vector<std::uint32_t> face_of = faces_of(mesh_, faces_.faces);
    product_.figures.inner_vertices = used_vertices(mesh_);
    product_.figures.inner_faces = distinct(face_of);
    product_.figures.inner_triangles = mesh_.triangles.size();
    if (pipeline_.free_distance == FreeDistance::constant) {
        free_distance_ = constant_distances(mesh_, face_of, faces_.generator_distance, d0_);
        return {};
    }
    return keep(bake::free_distances(mesh_, clearance_, obstacles_, 0.005 * unit_, stage_), free_distance_);
}

Result<void> Run::reduce() {
    eliminate_vertices(mesh_, free_distance_, settings_.swap_threshold * d0_ * d0_ * d0_);
    return {};
}

Result<void> Run::pack() {
    auto done = keep(bake::pack(mesh_, free_distance_, scene_, stage_), product_.contents);
    freespace::Metadata& metadata = product_.contents.metadata;
    metadata.map_name = scene_.name;
    metadata.source_name = scene_.source;
    metadata.source_hash = scene_.source_hash;
    metadata.metres_per_unit = static_cast<float>(scene_.metres_per_unit);
    metadata.d0 = static_cast<float>(d0_);
    return done;
}

}  // namespace

Result<Product> run(const Pipeline& pipeline, const scene::Scene& scene, const Settings& settings) {
    return tbb::task_arena(static_cast<int>(settings.threads)).execute([&] {
        return Run(pipeline, scene, settings).run();
    });
}

}  // namespace camdir::paper
