#include "camera/direction_costs.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/float4.hpp"

namespace camdir::camera {
namespace {

constexpr float degree = radians_of_a_degree<float>;
constexpr float angle_cost = 1.5F;
// From this far above the spot behind the player, the floor begins to fill the picture.
constexpr float view_from_above = 25.0F * degree;
constexpr float view_from_above_tolerance = 20.0F * degree;
constexpr float side_view_tolerance = 10.0F * degree;
constexpr float side_view_cost = 0.7F;
constexpr float side_view_limit = 2.0F;
constexpr double side_view_interval = 1.0 / 30.0;  // s, between the samples that are weighed

constexpr std::size_t quad_count = DirectionGrid::size / lane_count;
static_assert(quad_count * lane_count == DirectionGrid::size);

struct Quad {
    Float4 x, y, z;
    Float4 pitch;

    [[nodiscard]] Float4 dot(const Vec3f& direction) const {
        return x * direction.x() + y * direction.y() + z * direction.z();
    }
};

const std::array<Quad, quad_count>& quads() {
    static const std::array<Quad, quad_count> all = [] {
        std::array<Quad, quad_count> list;
        for (std::size_t bin = 0; bin < DirectionGrid::size; ++bin) {
            Quad& quad = list[bin / lane_count];
            const std::size_t lane = bin % lane_count;
            const Vec3f& direction = DirectionGrid::directions()[bin];
            quad.x[lane] = direction.x();
            quad.y[lane] = direction.y();
            quad.z[lane] = direction.z();
            quad.pitch[lane] = DirectionGrid::look(bin).pitch;
        }
        return list;
    }();
    return all;
}

// Within 7e-5 (Abramowitz and Stegun, 4.4.45), also of what rounding has left beyond 1.
Float4 arc_cosine(Float4 cosine) {
    const Float4 size = smaller(larger(cosine, -cosine), broadcast(1.0F));
    const Float4 series = ((-0.0187293F * size + 0.0742610F) * size - 0.2121144F) * size + 1.5707288F;
    const Float4 angle = square_root(1.0F - size) * series;
    return cosine < 0.0F ? std::numbers::pi_v<float> - angle : angle;
}

Float4 squared_share(Float4 value, float tolerance) {
    const Float4 share = value / tolerance;
    return share * share;
}

// Adds `cost` of each quad that has a direction that is not forbidden.
template <class Cost>
void add(DirectionCosts& costs, const Cost& cost) {
    for (std::size_t i = 0; i < quad_count; ++i) {
        float* const quad = &costs[i * lane_count];
        const Float4 before = load(quad);
        if (bits(before < forbidden) != 0) store(before + cost(quads()[i]), quad);
    }
}

void add_view_from_above(float behind, float cost, DirectionCosts& costs) {
    const float begin = std::max(0.0F, behind) + view_from_above;
    add(costs, [&](const Quad& quad) {
        const Float4 above = larger(quad.pitch - begin, Float4{});
        return cost * squared_share(above, view_from_above_tolerance);
    });
}

void add_side_view(const Vec3f& view, float begin, float cost, DirectionCosts& costs) {
    const float cosine_at_begin = std::cos(begin);
    add(costs, [&](const Quad& quad) {
        const Float4 cosine = -quad.dot(view);
        if (bits(cosine < cosine_at_begin) == 0) return Float4{};
        const Float4 beyond = larger(arc_cosine(cosine) - begin, Float4{});
        return cost * smaller(squared_share(beyond, side_view_tolerance), broadcast(side_view_limit));
    });
}

}  // namespace

void weigh_directions(const MapProfile& profile, const Plan& plan, std::size_t first, DirectionCosts& costs) {
    const Look look_behind = plan.behind(first, profile.elevation);
    const Vec3f behind = direction_of(look_behind);
    const float cost = angle_cost * profile.weight_angle;
    const float least_cosine = std::cos(profile.swing);
    for (std::size_t i = 0; i < quad_count; ++i) {
        const Float4 cosine = quads()[i].dot(behind);
        const Float4 off = cost * squared_share(arc_cosine(cosine), profile.angle_tolerance);
        store(cosine < least_cosine ? broadcast(2.0F * forbidden) : off, &costs[i * lane_count]);
    }
    add_view_from_above(look_behind.pitch, profile.weight_angle, costs);

    const float begin = Plan::side_view(profile);
    const std::size_t stride = plan.samples_in(side_view_interval);
    const auto share =
        static_cast<float>(static_cast<double>(stride) * plan.future.step / side_view_interval);
    const std::size_t end = std::min(plan.count(), first + plan.knot_spacing);
    for (std::size_t i = first; i < end; i += stride)
        add_side_view(direction_of(plan.future[i].view), begin, share * side_view_cost * profile.weight_angle,
                      costs);
}

void add_turn(const Vec3f& from, float cost, DirectionCosts& costs) {
    add(costs, [&](const Quad& quad) {
        return cost * squared_share(arc_cosine(quad.dot(from)), DirectionGrid::spacing);
    });
}

}  // namespace camdir::camera
