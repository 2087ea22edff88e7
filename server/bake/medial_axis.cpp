#include "bake/medial_axis.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>

namespace camdir::bake {
namespace {

class Prober {
  public:
    Prober(const Obstacles& obstacles, const Solids& solids, const Probing& probing, const Stage& stage)
        : obstacles_(obstacles), solids_(solids), probing_(probing), stage_(stage) {}

    void probe(const Triangle3d& t, std::vector<Vec3d>& centres) {
        const Vec3d normal = (t[1] - t[0]).cross(t[2] - t[0]);
        if (normal.squaredNorm() > 0.0) probe(t, normal.normalized(), centres);
        found_ += centres.size() % block;
    }

  private:
    void probe(const Triangle3d& t, const Vec3d& normal, std::vector<Vec3d>& centres) {
        if (stage_.stopping() || found_ > probing_.max_points || solids_.is_buried(t, offset())) return;
        const Vec3d q = (t[0] + t[1] + t[2]) / 3.0;
        const double above = radius(q, normal);
        const double below = radius(q, -normal);
        const double extent = std::sqrt(
            std::max({(t[0] - q).squaredNorm(), (t[1] - q).squaredNorm(), (t[2] - q).squaredNorm()}));
        const double smallest =
            std::min(above > 0.0 ? above : probing_.reach, below > 0.0 ? below : probing_.reach);
        const bool hidden = above == 0.0 && below == 0.0;
        if (extent > std::max(probing_.finest, hidden ? 0.0 : 0.5 * smallest)) {
            for (const Triangle3d& half : halves(t))
                probe(half, normal, centres);
            return;
        }
        if (above > 0.0 && above < probing_.reach) add(q + above * normal, centres);
        if (below > 0.0 && below < probing_.reach) add(q - below * normal, centres);
    }

    // Counts in blocks: the counter is shared by all threads.
    void add(const Vec3d& centre, std::vector<Vec3d>& centres) {
        centres.push_back(centre);
        if (centres.size() % block == 0) found_ += block;
    }

    static constexpr std::uint64_t block = 64;

    // 0 when the side is in a solid.
    [[nodiscard]] double radius(const Vec3d& q, const Vec3d& normal) const {
        if (solids_.contains(q + offset() * normal)) return 0.0;
        return shrinking_ball_radius(q, normal, probing_.reach, obstacles_);
    }

    // How far from a surface its sides are tested for solids.
    [[nodiscard]] double offset() const { return 0.001 * probing_.finest; }

    const Obstacles& obstacles_;
    const Solids& solids_;
    const Probing& probing_;
    const Stage& stage_;
    std::atomic<std::uint64_t> found_ = 0;
};

}  // namespace

// Shrinks the ball, obstacle by obstacle, to the one through `q` and the obstacle point deepest inside. Balls
// only shrink within themselves, so that each obstacle is examined once.
double shrinking_ball_radius(const Vec3d& q, const Vec3d& normal, double reach, const Obstacles& obstacles) {
    constexpr int max_steps = 64;
    constexpr double rounding = 1.0 - 1e-4;
    double radius = reach;
    const auto power = [&](double distance2) { return distance2 - radius * radius * rounding * rounding; };
    const auto shrink_from = [&](const Triangle3d& obstacle) {
        for (int step = 0; step < max_steps; ++step) {
            const Vec3d centre = q + radius * normal;
            const Vec3d nearest = closest_point(obstacle, centre);
            if (power((nearest - centre).squaredNorm()) >= 0.0) return;
            const Vec3d to_nearest = nearest - q;
            radius = std::min(radius * rounding, to_nearest.squaredNorm() / (2.0 * normal.dot(to_nearest)));
        }
    };
    obstacles.tree().visit_by(
        [&](const Box3d& box) { return power(box.squaredExteriorDistance(q + radius * normal)); },
        [] { return 0.0; }, [&](std::uint32_t position) { shrink_from(obstacles.triangles()[position]); });
    return radius;
}

Result<std::vector<Vec3d>> medial_axis(const Obstacles& obstacles, const Solids& solids,
                                       const Probing& probing, Stage& stage) {
    const std::vector<Triangle3d>& triangles = obstacles.triangles();
    Prober prober(obstacles, solids, probing, stage);
    std::vector<std::vector<Vec3d>> centres_of(triangles.size());
    const bool done =
        stage.for_each(triangles.size(), [&](std::uint64_t i) { prober.probe(triangles[i], centres_of[i]); });
    if (!done) return stage.interrupted();
    std::vector<Vec3d> centres;
    for (const std::vector<Vec3d>& of_one : centres_of)
        centres.insert(centres.end(), of_one.begin(), of_one.end());
    stage.count("points", static_cast<double>(centres.size()));
    return centres;
}

}  // namespace camdir::bake
