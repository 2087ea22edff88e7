#include "freespace/visibility.hpp"

#include <algorithm>
#include <cmath>

#include "freespace/search.hpp"

namespace camdir::freespace {
namespace {

// A march takes a few balls; one that needs more creeps towards a pinch and is given up.
constexpr int ball_limit = 256;
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

float round_down(double positive) {
    return std::max(std::nextafter(static_cast<float>(positive), 0.0F), 0.0F);
}

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

SlabPoint best_near(const Freespace& freespace, const Vec3f& point, std::uint32_t previous, float beam) {
    SlabPoint best;
    best.value = beam;
    if (previous < freespace.triangles().size()) improve_by_ring(freespace, point, previous, best);
    if (best.triangle == none) improve_everywhere(freespace.mesh(), point, best);
    return best;
}

Sight march(const Freespace& freespace, const Ray& ray, double beam, std::uint32_t previous) {
    Sight sight;
    double reached = 0.0;  // free up to here
    SlabPoint best = best_near(freespace, ray.at(0.0), previous, static_cast<float>(beam));
    if (best.triangle == none) return sight;
    RayBall ball(ray, ball_at(freespace.mesh(), best));
    double clearance = ball.clearance(0.0);
    if (!(clearance > beam)) return sight;
    for (int i = 0; i < ball_limit; ++i) {
        sight.triangle = best.triangle;
        const double exit = ball.exit(beam);
        if (exit >= ray.length) {
            sight.clear = true;
            reached = ray.length;
            break;
        }
        const double entered = reached;
        reached = exit;
        best = best_near(freespace, ray.at(reached), best.triangle, static_cast<float>(beam));
        if (best.triangle == none) break;
        const RayBall next(ray, ball_at(freespace.mesh(), best));
        if (!(next.clearance(reached) > beam) || !(next.exit(beam) > reached)) break;
        const double change = changeover(ball, next, entered, reached);
        clearance = std::min({clearance, ball.clearance(change), next.clearance(change)});
        ball = next;
    }
    clearance = std::min(clearance, ball.clearance(reached));
    sight.free_length = sight.clear ? static_cast<float>(ray.length) : round_down(reached);
    sight.clearance = round_down(clearance);
    return sight;
}

}  // namespace

Sight sight(const Freespace& freespace, const Vec3f& from, const Vec3f& to, float radius,
            std::uint32_t previous) {
    if (!from.allFinite() || !to.allFinite() || !std::isfinite(radius)) return {};
    const Vec3d start = from.cast<double>();
    const Vec3d span = to.cast<double>() - start;
    const double length = span.norm();
    const Vec3d direction = length > 0.0 ? Vec3d(span / length) : Vec3d::UnitX();
    return march(freespace, {start, direction, length}, radius, previous);
}

}  // namespace camdir::freespace
