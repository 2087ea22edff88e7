#include "freespace/visibility.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/round_down.hpp"
#include "freespace/search.hpp"

namespace camdir::freespace {
namespace {

// A march takes a few balls; one that needs more creeps towards a pinch and is given up.
constexpr int ball_limit = 128;
// The march ends when no ball carries it on by this share of the last ball's radius, or of the segment where
// that is shorter.
constexpr double least_gain = 0.01;
// A ball that is large enough is not improved for long: a slightly smaller one carries nearly as far.
constexpr float sight_slack = 0.25F;
constexpr std::uint32_t sight_leaves = 32;
// Shrinks a ball before the exit from it is computed, so that rounding never carries the walk out of it.
constexpr double shrink = 1.0 - 1e-9;

// The segment of sight with lengths measured from its start.
struct Ray {
    Vec3d start;
    Vec3d direction;  // unit
    double length;

    [[nodiscard]] Vec3f at(double t) const { return (start + t * direction).cast<float>(); }
};

// A ball as the ray sees it: its clearance at t is radius - sqrt(offset2 + (t - along)^2), which is concave.
struct RayBall {
    double along;
    double offset2;
    double radius;

    RayBall(const Ray& ray, const Ball& ball) : radius(ball.radius) {
        const Vec3d relative = ball.centre - ray.start;
        along = relative.dot(ray.direction);
        offset2 = (relative - along * ray.direction).squaredNorm();
    }
    [[nodiscard]] double clearance(double t) const {
        return radius - std::sqrt(offset2 + (t - along) * (t - along));
    }
    // Where the beam leaves the ball; only for beams that the ball holds somewhere.
    [[nodiscard]] double exit(double beam) const {
        const double reach = radius * shrink - beam;
        return along + std::sqrt(std::max(reach * reach - offset2, 0.0));
    }
};

// Where on [begin, end] the walk should change from `from` to `to`: near the point where both know the same
// clearance. `from` is the better one at `begin`, `to` at `end`. Any answer is safe.
double changeover(const RayBall& from, const RayBall& to, double begin, double end) {
    double low = begin;
    double high = end;
    for (int i = 0; i < 4; ++i) {
        const double middle = 0.5 * (low + high);
        (from.clearance(middle) > to.clearance(middle) ? low : high) = middle;
    }
    return high;
}

// A ball of the walk and the slab that it comes from.
struct Step {
    std::uint32_t triangle;
    RayBall ball;

    // Holds the beam at t, and carries it to the end or by more than `gain`.
    [[nodiscard]] bool carries_on(const Ray& ray, double t, double beam, double gain) const {
        const double exit = ball.exit(beam);
        return ball.clearance(t) > beam && (exit >= ray.length || exit - t > gain);
    }
};

// A ball that holds the beam at t and carries it on by more than `gain`. What is tried grows until one does;
// a ball whose clearance at t exceeds the beam by more than `gain` is never missed, but for rounding.
std::optional<Step> find_step(const Freespace& freespace, const Ray& ray, double t, double beam, double gain,
                              std::uint32_t previous) {
    const MeshView& mesh = freespace.mesh();
    const Vec3f point = ray.at(t);
    SlabPoint best = uncovered;
    best.value = static_cast<float>(beam);
    std::optional<Step> step;
    const auto found = [&] {
        if (best.triangle == none) return false;
        step = Step{best.triangle, RayBall(ray, ball_at(mesh, best))};
        return step->carries_on(ray, t, beam, gain);
    };
    improve_by_hints(mesh, point, previous, best);
    if (found()) return step;
    improve_by_hints_around(mesh, point, best);
    if (found()) return step;
    const Effort effort{static_cast<float>(beam + gain), sight_slack, sight_leaves};
    improve_everywhere(mesh, point, effort, best);
    if (found()) return step;
    return std::nullopt;
}

Sight march(const Freespace& freespace, const Ray& ray, double beam, std::uint32_t previous) {
    Sight sight;
    std::optional<Step> step = find_step(freespace, ray, 0.0, beam, 0.0, previous);
    if (!step) return sight;
    double reached = 0.0;  // free up to here
    double clearance = step->ball.clearance(0.0);
    for (int i = 0; i < ball_limit; ++i) {
        const RayBall ball = step->ball;
        sight.triangle = step->triangle;
        const double entered = reached;
        reached = std::min(ball.exit(beam), ray.length);
        sight.clear = reached == ray.length;
        if (sight.clear) break;
        const double gain = least_gain * std::min(ball.radius, ray.length);
        step = find_step(freespace, ray, reached, beam, gain, sight.triangle);
        if (!step) break;
        const double change = changeover(ball, step->ball, entered, reached);
        clearance = std::min({clearance, ball.clearance(change), step->ball.clearance(change)});
    }
    if (step) clearance = std::min(clearance, step->ball.clearance(reached));
    sight.free_length = sight.clear ? static_cast<float>(ray.length) : round_down(reached);
    sight.clearance = round_down(step ? std::max(clearance, 0.0) : beam);
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
    return march(freespace, {start, direction, length}, radius, previous);
}

}  // namespace camdir::freespace
