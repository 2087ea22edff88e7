#include "freespace/visibility.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/round_down.hpp"
#include "freespace/search.hpp"

namespace camdir::freespace {
namespace {

// Most marches take a few balls; one that needs more creeps towards a pinch.
constexpr int ball_limit = 128;
// The march ends when no ball carries it on by this share of the last ball's radius, or of the segment where
// that is shorter.
constexpr double least_gain = 0.01;
// Once a ball carries on, the search for a better one is limited: a slightly smaller one carries nearly as
// far.
constexpr float sight_slack = 0.25F;
constexpr std::uint32_t sight_leaves = 32;
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
        const double reach = radius * shrink - sphere_radius;
        return along + std::sqrt(std::max(reach * reach - offset2, 0.0));
    }
};

// Where on [begin, end] the march should change from ball `from` to ball `to`: near the point where both give
// the same clearance. `from` is the better one at `begin`, `to` at `end`. Any answer is safe.
double changeover(const BallOnSegment& from, const BallOnSegment& to, double begin, double end) {
    double low = begin;
    double high = end;
    for (int i = 0; i < 4; ++i) {
        const double middle = 0.5 * (low + high);
        (from.clearance(middle) > to.clearance(middle) ? low : high) = middle;
    }
    return high;
}

// A ball of the march and the slab that it comes from.
struct Step {
    std::uint32_t triangle;
    BallOnSegment ball;

    // Contains the sphere at t, and carries it to the end or by more than `gain`.
    [[nodiscard]] bool carries_on(const Sweep& sweep, double t, double gain) const {
        const double exit = ball.exit(sweep.radius);
        return ball.clearance(t) > sweep.radius && (exit >= sweep.length || exit - t > gain);
    }
};

// A ball that contains the sphere at t and carries it on by more than `gain`. What is tried grows until one
// does; the search ends without one only if no clearance at t exceeds the sphere's radius by more than
// `gain`, but for rounding.
std::optional<Step> find_step(const Freespace& freespace, const Sweep& sweep, double t, double gain,
                              std::uint32_t previous) {
    const MeshView& mesh = freespace.mesh();
    const Vec3f point = sweep.at(t);
    SlabPoint best = uncovered;
    best.value = static_cast<float>(sweep.radius);
    std::optional<Step> step;
    const auto found = [&] {
        if (best.triangle == none) return false;
        step = Step{best.triangle, BallOnSegment(sweep, ball_at(mesh, best))};
        return step->carries_on(sweep, t, gain);
    };
    improve_by_hints(mesh, point, previous, best);
    if (found()) return step;
    improve_by_hints_around(mesh, point, best);
    if (found()) return step;
    const Effort effort{static_cast<float>(sweep.radius + gain), sight_slack, sight_leaves};
    improve_everywhere(mesh, point, effort, best);
    if (found()) return step;
    return std::nullopt;
}

Sight march(const Freespace& freespace, const Sweep& sweep, std::uint32_t previous) {
    Sight sight;
    std::optional<Step> step = find_step(freespace, sweep, 0.0, 0.0, previous);
    if (!step) return sight;
    double reached = 0.0;  // free up to here
    double clearance = step->ball.clearance(0.0);
    for (int i = 0; i < ball_limit; ++i) {
        const BallOnSegment ball = step->ball;
        sight.triangle = step->triangle;
        const double entered = reached;
        reached = std::min(ball.exit(sweep.radius), sweep.length);
        sight.clear = reached == sweep.length;
        if (sight.clear) break;
        const double gain = least_gain * std::min(ball.radius, sweep.length);
        step = find_step(freespace, sweep, reached, gain, sight.triangle);
        if (!step) break;
        const double change = changeover(ball, step->ball, entered, reached);
        clearance = std::min({clearance, ball.clearance(change), step->ball.clearance(change)});
    }
    if (step) clearance = std::min(clearance, step->ball.clearance(reached));
    sight.free_length = sight.clear ? static_cast<float>(sweep.length) : round_down(reached);
    sight.clearance = round_down(step ? std::max(clearance, 0.0) : sweep.radius);
    return sight;
}

}  // namespace

Sight sight(const Freespace& freespace, const Vec3f& from, const Vec3f& to, float radius,
            std::uint32_t previous) {
    if (!from.allFinite() || !to.allFinite() || !std::isfinite(radius) || radius < 0.0F) return {};
    const Vec3d start = from.cast<double>();
    const Vec3d span = to.cast<double>() - start;
    const double length = span.norm();
    const Vec3d direction = length > 0.0 ? Vec3d(span / length) : Vec3d::UnitX();
    return march(freespace, {start, direction, length, radius}, previous);
}

}  // namespace camdir::freespace
