#include "freespace/visibility.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>

#include "base/float4.hpp"
#include "base/round_down.hpp"
#include "freespace/slab_octree.hpp"

namespace camdir::freespace {
namespace {

// Most marches take a few balls; one that needs more creeps towards a pinch.
constexpr int ball_limit = 128;
// The march ends when no ball carries it on by this share of the last ball's radius.
constexpr double least_gain = 0.01;
// With recent balls the march ends sooner, by this share; and one that carries on by less than this share of
// its own radius is not worth going through.
constexpr double least_hop = 0.1;
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

// A ball that the march may go on through.
struct Found {
    BallOnSegment ball;
    std::uint32_t triangle;
};

// Carries the sphere at t, where the ball's clearance is `here`, to the end, or on by more than `gain`.
bool carries_on(const Sweep& sweep, double t, double here, double exit, double gain) {
    return here > sweep.radius && (exit >= sweep.length || exit - t > gain);
}

// `next_ball` gives a ball at t, if there is one; one that carries on by more than `gain` where it can. The
// march ends where none does: `gain` is `least_share` of the last ball's radius, or of the segment where that
// is shorter.
template <class NextBall>
Sight march(const Sweep& sweep, double least_share, const NextBall& next_ball) {
    Sight sight;
    std::optional<BallOnSegment> last;
    double entered = 0.0;  // where the last ball was entered
    double entry = 0.0;    // its clearance there
    double reached = 0.0;  // free up to here
    double gain = 0.0;
    double clearance = std::numeric_limits<double>::infinity();
    for (int i = 0; i < ball_limit; ++i) {
        const std::optional<Found> next = next_ball(reached, gain);
        if (!next) break;
        const BallOnSegment& ball = next->ball;
        const double here = ball.clearance(reached);
        const double exit = ball.exit(sweep.radius);
        if (!carries_on(sweep, reached, here, exit, gain)) break;
        double change = 0.0;
        if (last) {
            change = changeover(entered, reached, entry - ball.clearance(entered),
                                here - last->clearance(reached));
            clearance = std::min(clearance, last->clearance(change));
        }
        clearance = std::min(clearance, ball.clearance(change));
        sight.triangle = next->triangle;
        entered = reached;
        entry = here;
        reached = std::min(exit, sweep.length);
        last = ball;
        sight.clear = reached == sweep.length;
        if (sight.clear) break;
        gain = least_share * std::min(ball.radius, sweep.length);
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

// Where on a segment the sphere is inside of recent balls.
class BallIntervals {
  public:
    BallIntervals(const RecentBalls& balls, const Sweep& sweep) {
        const Vec3f start = sweep.start.cast<float>();
        const Vec3f direction = sweep.direction.cast<float>();
        for (std::size_t i = 0; i < RecentBalls::capacity; i += lane_count) {
            const Float4 x = load(&balls.x_[i]) - start.x();
            const Float4 y = load(&balls.y_[i]) - start.y();
            const Float4 z = load(&balls.z_[i]) - start.z();
            const Float4 along = x * direction.x() + y * direction.y() + z * direction.z();
            const Float4 off_x = x - along * direction.x();
            const Float4 off_y = y - along * direction.y();
            const Float4 off_z = z - along * direction.z();
            const Float4 reach = load(&balls.radius_[i]) - static_cast<float>(sweep.radius);
            const Float4 half2 = reach * reach - (off_x * off_x + off_y * off_y + off_z * off_z);
            const Float4 half = square_root(larger(half2, Float4{}));
            const Mask4 inside = (reach > 0.0F) & (half2 > 0.0F);
            begin_[i / lane_count] = along - half;
            end_[i / lane_count] = inside ? along + half : broadcast(-1.0F);
        }
    }

    // The ball that holds the sphere at t, and after it the longest, but for rounding. Negative: none.
    [[nodiscard]] int furthest(float t) const {
        Float4 end = broadcast(t);
        Mask4 ball = {-1, -1, -1, -1};
        Mask4 number = {0, 1, 2, 3};
        for (std::size_t i = 0; i < begin_.size(); ++i) {
            const Mask4 further = (begin_[i] < t) & (end_[i] > end);
            end = further ? end_[i] : end;
            ball = further ? number : ball;
            number += lane_count;
        }
        return ball[std::countr_zero(bits(end == broadcast(largest(end))))];
    }

  private:
    std::array<Float4, RecentBalls::capacity / lane_count> begin_, end_;
};

void RecentBalls::add(const Ball& ball, std::uint32_t triangle) {
    const Vec3f centre = ball.centre.cast<float>();
    x_[next_] = centre.x();
    y_[next_] = centre.y();
    z_[next_] = centre.z();
    radius_[next_] = round_down(ball.radius - (ball.centre - centre.cast<double>()).norm());
    triangle_[next_] = triangle;
    next_ = (next_ + 1) % capacity;
}

SightOrigin::SightOrigin(const Freespace& freespace, const Vec3f& from, float radius)
    : octree_(&freespace.octree()), from_(from), radius_(radius) {
    if (from.allFinite() && is_radius(radius)) first_ = octree_->best(from, radius);
}

Sight SightOrigin::to(const Vec3f& end) const {
    if (first_.triangle == none || !end.allFinite()) return {};
    const Sweep sweep = sweep_of(from_, end, radius_);
    return march(sweep, least_gain, [&](double t, double) -> std::optional<Found> {
        const SlabPoint point = t > 0.0 ? roomiest(*octree_, sweep, t) : first_;
        if (point.triangle == none) return std::nullopt;
        return Found{{sweep, octree_->ball(point)}, point.triangle};
    });
}

Sight sight(const Freespace& freespace, const Vec3f& from, const Vec3f& to, float radius) {
    return SightOrigin(freespace, from, radius).to(to);
}

Sight sight(const Freespace& freespace, const Vec3f& from, const Vec3f& to, float radius,
            RecentBalls& recent) {
    if (!from.allFinite() || !to.allFinite() || !is_radius(radius)) return {};
    const SlabOctree& octree = freespace.octree();
    const Sweep sweep = sweep_of(from, to, radius);
    const BallIntervals intervals(recent, sweep);
    return march(sweep, least_hop, [&](double t, double gain) -> std::optional<Found> {
        if (const int known = intervals.furthest(static_cast<float>(t)); known >= 0) {
            const auto i = static_cast<std::size_t>(known);
            const BallOnSegment ball(sweep, recent.ball(i));
            const double worth = std::max(gain, least_hop * ball.radius);
            if (carries_on(sweep, t, ball.clearance(t), ball.exit(sweep.radius), worth))
                return Found{ball, recent.triangle(i)};
        }
        const SlabPoint point = roomiest(octree, sweep, t);
        if (point.triangle == none) return std::nullopt;
        const Ball ball = octree.ball(point);
        recent.add(ball, point.triangle);
        return Found{{sweep, ball}, point.triangle};
    });
}

}  // namespace camdir::freespace
