#include "freespace/visibility.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/round_down.hpp"
#include "freespace/slab_octree.hpp"

namespace camdir::freespace {
namespace {

// Most marches take a few balls; one that needs more creeps towards a pinch.
constexpr int ball_limit = 128;
// The march ends when no ball carries it on by this share of the last ball's radius, or of the segment where
// that is shorter.
constexpr double least_gain = 0.01;
// Shrinks a ball before the exit from it is computed, so that rounding never places the exit outside of it.
constexpr double shrink = 1.0 - 1e-9;

// The segment and the sphere that is swept along it. Lengths are measured from the start.
struct Sweep {
    Vec3d start;
    Vec3d direction;  // unit
    double length;
    double radius;  // of the sphere

    [[nodiscard]] Vec3f at(double t) const { return (start + t * direction).cast<float>(); }
};

// A ball in the coordinates of the segment. Its clearance at t is radius - sqrt(offset2 + (t - along)^2),
// which is concave.
struct BallOnSegment {
    double along;    // of the centre's projection
    double offset2;  // squared distance of the centre from the line
    double radius;

    BallOnSegment(const Sweep& sweep, const Ball& ball) : radius(ball.radius) {
        const Vec3d relative = ball.centre - sweep.start;
        along = relative.dot(sweep.direction);
        offset2 = (relative - along * sweep.direction).squaredNorm();
    }
    [[nodiscard]] double clearance(double t) const {
        return radius - std::sqrt(offset2 + (t - along) * (t - along));
    }
    // Where the sphere leaves the ball, if the ball contains it somewhere on the segment.
    [[nodiscard]] double exit(double sphere_radius) const {
        const double reach = std::max(radius * shrink - sphere_radius, 0.0);
        return along + std::sqrt(std::max(reach * reach - offset2, 0.0));
    }
};

// Where on [begin, end] the march should change from one ball to the next: near the point where both give the
// same clearance. `ahead`: by how much the first one's is larger at `begin`; `behind`: the next one's at
// `end`. Any answer is safe.
double changeover(double begin, double end, double ahead, double behind) {
    return ahead > 0.0 && behind > 0.0 ? begin + (end - begin) * (ahead / (ahead + behind)) : end;
}

// The slab point that leaves the most room at the segment's point t; none without room for the sphere.
SlabPoint roomiest(const SlabOctree& octree, const Sweep& sweep, double t) {
    return octree.best(sweep.at(t), static_cast<float>(sweep.radius));
}

// `next`: the slab point for the next ball.
Sight march(const SlabOctree& octree, const Sweep& sweep, SlabPoint next) {
    Sight sight;
    std::optional<BallOnSegment> last;
    double entered = 0.0;  // where the last ball was entered
    double entry = 0.0;    // its clearance there
    double reached = 0.0;  // free up to here
    double gain = 0.0;     // that the next ball must bring, unless it reaches the end
    double clearance = std::numeric_limits<double>::infinity();
    for (int i = 0; i < ball_limit && next.triangle != none; ++i) {
        const BallOnSegment ball(sweep, octree.ball(next));
        const double here = ball.clearance(reached);
        const double exit = ball.exit(sweep.radius);
        if (!(here > sweep.radius && (exit >= sweep.length || exit - reached > gain))) break;
        double change = 0.0;
        if (last) {
            change = changeover(entered, reached, entry - ball.clearance(entered),
                                here - last->clearance(reached));
            clearance = std::min(clearance, last->clearance(change));
        }
        clearance = std::min(clearance, ball.clearance(change));
        sight.triangle = next.triangle;
        entered = reached;
        entry = here;
        reached = std::min(exit, sweep.length);
        last = ball;
        sight.clear = reached == sweep.length;
        if (sight.clear) break;
        gain = least_gain * std::min(ball.radius, sweep.length);
        next = roomiest(octree, sweep, reached);
    }
    if (!last) return sight;
    clearance = std::min(clearance, last->clearance(reached));
    sight.free_length = sight.clear ? static_cast<float>(sweep.length) : round_down(reached);
    sight.clearance = round_down(sight.clear ? std::max(clearance, 0.0) : sweep.radius);
    return sight;
}

bool is_radius(float radius) {
    return std::isfinite(radius) && radius >= 0.0F;
}

Sweep sweep_of(const Vec3f& from, const Vec3f& to, float radius) {
    const Vec3d start = from.cast<double>();
    const Vec3d span = to.cast<double>() - start;
    const double length = span.norm();
    return {start, length > 0.0 ? Vec3d(span / length) : Vec3d::UnitX(), length, radius};
}

}  // namespace

SightOrigin::SightOrigin(const Freespace& freespace, const Vec3f& from, float radius)
    : octree_(&freespace.octree()), from_(from), radius_(radius) {
    if (from.allFinite() && is_radius(radius)) first_ = octree_->best(from, radius);
}

Sight SightOrigin::to(const Vec3f& end) const {
    if (first_.triangle == none || !end.allFinite()) return {};
    return march(*octree_, sweep_of(from_, end, radius_), first_);
}

Sight sight(const Freespace& freespace, const Vec3f& from, const Vec3f& to, float radius) {
    return SightOrigin(freespace, from, radius).to(to);
}

}  // namespace camdir::freespace
