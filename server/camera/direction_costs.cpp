#include "camera/direction_costs.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "base/float4.hpp"

namespace camdir::camera {
namespace {

constexpr float degree = radians_of_a_degree<float>;
constexpr float angle_cost = 1.5F;
// From this far above the spot behind the player, the floor begins to fill the picture.
constexpr float begin_above = 25.0F * degree;
constexpr float view_from_above_tolerance = 20.0F * degree;
constexpr float side_view_tolerance = 10.0F * degree;
constexpr float side_view_cost = 0.7F;
constexpr float side_view_limit = 2.0F;
constexpr double side_view_interval = 1.0 / 30.0;  // s, between the samples that are weighed

// A body as balls below the eye, units.
constexpr float body_radius = 18.0F;
constexpr std::array body_parts = {2.0F, 32.0F};
constexpr float beside_body = 12.0F * degree;

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

// Costs more the further a direction is above the spot behind the player.
class ViewFromAbove {
  public:
    ViewFromAbove(float behind, float cost) : begin_(std::max(0.0F, behind) + begin_above), cost_(cost) {}

    [[nodiscard]] Float4 operator()(const Quad& quad) const {
        const Float4 above = larger(quad.pitch - begin_, Float4{});
        return cost_ * squared_share(above, view_from_above_tolerance);
    }

  private:
    float begin_;
    float cost_;
};

// Costs more the further to the side a direction sees the player, at some instants.
class SideView {
  public:
    SideView(float begin, float cost) : begin_(begin), cosine_at_begin_(std::cos(begin)), cost_(cost) {}

    void look_at(const Vec3f& view) {
        assert(count_ < views_.size());
        views_[count_++] = view;
    }
    // Adds to `costs`.
    void add(const Quad& quad, Float4& costs) const {
        for (std::size_t i = 0; i < count_; ++i) {
            const Float4 cosine = -quad.dot(views_[i]);
            if (bits(cosine < cosine_at_begin_) == 0) continue;
            const Float4 beyond = larger(arc_cosine(cosine) - begin_, Float4{});
            costs += cost_ * smaller(squared_share(beyond, side_view_tolerance), broadcast(side_view_limit));
        }
    }

  private:
    float begin_;
    float cosine_at_begin_;
    float cost_;
    std::array<Vec3f, 8> views_;  // a knot has four or five instants, 7 at most
    std::size_t count_ = 0;
};

// As balls, seen from the player's eye.
class Body {
  public:
    Body(const Vec3f& offset, const MapProfile& profile) {
        const float radius = body_radius * profile.unit;
        for (const float below : body_parts) {
            const Vec3f centre = offset - below * profile.unit * Vec3f::UnitZ();
            const float distance = centre.norm();
            // One who is in the player has no direction; behind the camera nobody is in its way.
            if (distance <= radius || distance >= profile.distance + radius) continue;
            const float wide = std::asin(radius / distance);
            balls_[count_++] = {centre / distance, wide, std::cos(wide + beside_body)};
        }
    }

    [[nodiscard]] bool is_in_reach() const { return count_ != 0; }
    // 1: it is on the line of sight, 0: well beside it.
    [[nodiscard]] Float4 share_of(const Quad& quad) const {
        Float4 share{};
        for (std::size_t i = 0; i < count_; ++i) {
            const Float4 cosine = quad.dot(balls_[i].direction);
            if (bits(cosine > balls_[i].cosine_beside) == 0) continue;
            const Float4 beside = larger(arc_cosine(cosine) - balls_[i].wide, Float4{});
            share = larger(share, 1.0F - beside / beside_body);
        }
        return share;
    }

  private:
    struct Ball {
        Vec3f direction;
        float wide;           // rad
        float cosine_beside;  // beyond it costs nothing
    };
    std::array<Ball, body_parts.size()> balls_;
    std::size_t count_ = 0;
};

}  // namespace

void weigh_directions(const MapProfile& profile, const Plan& plan, std::size_t first, DirectionCosts& costs) {
    const Look look_behind = plan.behind(first, profile.elevation);
    const Vec3f behind = direction_of(look_behind);
    const float cost = angle_cost * profile.weight_angle;
    const float least_cosine = std::cos(profile.swing);
    const ViewFromAbove view_from_above(look_behind.pitch, profile.weight_angle);

    const std::size_t stride = plan.samples_in(side_view_interval);
    const auto share =
        static_cast<float>(static_cast<double>(stride) * plan.future.step / side_view_interval);
    SideView side_view(Plan::side_view(profile), share * side_view_cost * profile.weight_angle);
    const std::size_t end = std::min(plan.count(), first + plan.knot_spacing);
    for (std::size_t i = first; i < end; i += stride)
        side_view.look_at(plan.view[i]);

    const auto& all = quads();
    for (std::size_t i = 0; i < quad_count; ++i) {
        const Quad& quad = all[i];
        const Float4 cosine = quad.dot(behind);
        Float4 sum = broadcast(2.0F * forbidden);
        if (bits(cosine >= least_cosine) != 0) {
            const Float4 off = cost * squared_share(arc_cosine(cosine), profile.angle_tolerance);
            sum = (cosine < least_cosine ? sum : off) + view_from_above(quad);
            side_view.add(quad, sum);
        }
        store(sum, &costs[i * lane_count]);
    }
}

void add_bodies(const MapProfile& profile, std::span<const Vec3f> offsets, float cost,
                DirectionCosts& costs) {
    const auto& all = quads();
    for (const Vec3f& offset : offsets) {
        const Body body(offset, profile);
        if (!body.is_in_reach()) continue;
        for (std::size_t i = 0; i < quad_count; ++i) {
            const Float4 share = body.share_of(all[i]);
            if (bits(share > Float4{}) == 0) continue;
            float* const quad = &costs[i * lane_count];
            store(load(quad) + cost * share, quad);
        }
    }
}

void add_turn(const Vec3f& from, float cost, DirectionCosts& costs) {
    const auto& all = quads();
    for (std::size_t i = 0; i < quad_count; ++i) {
        float* const quad = &costs[i * lane_count];
        const Float4 before = load(quad);
        if (bits(before < forbidden) == 0) continue;
        store(before + cost * squared_share(arc_cosine(all[i].dot(from)), DirectionGrid::spacing), quad);
    }
}

}  // namespace camdir::camera
