#include "director/scout.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "freespace/fixed_shots.hpp"
#include "freespace/visibility.hpp"

namespace camdir::director {
namespace {

constexpr float distance = 120.0F;   // units of 0.0254 m
constexpr float clearance = 4.5F;    // likewise, round the way to the camera
constexpr float to_centre = -22.0F;  // from the eye to the middle of the body

// The middle of the body.
Vec3f centre_below(const Vec3f& eye, float unit) {
    return eye + to_centre * unit * Vec3f::UnitZ();
}

bool is_in_mover(const freespace::Space& space, const Vec3f& point) {
    return space.mover_distance(point, 0.0F).mover != freespace::none;
}

// Who sits in a vehicle sees and is seen as if nothing moved.
bool movers_hide(const freespace::Space& space, const Vec3f& from, const Vec3f& to) {
    return !space.mover_sweep(from, to, 0.0F).clear && !is_in_mover(space, from) && !is_in_mover(space, to);
}

// What is seen from a point.
class Viewpoint {
  public:
    Viewpoint(const freespace::Space& space, const Vec3f& position)
        : space_(space), position_(position), origin_(space.map(), position, 0.0F) {}

    [[nodiscard]] bool sees(const Vec3f& point) const {
        return origin_.to(point).clear && !movers_hide(space_, position_, point);
    }

  private:
    const freespace::Space& space_;
    Vec3f position_;
    freespace::SightOrigin origin_;
};

// Where the camera looks. Its horizon is level.
class Picture {
  public:
    Picture(const Vec3f& position, const Vec3f& forward) : position_(position), forward_(forward) {
        const Vec3f level = forward.cross(Vec3f::UnitZ());
        right_ = level.norm() > 1e-6F ? level.normalized() : -Vec3f::UnitY();
        up_ = right_.cross(forward_);
    }

    [[nodiscard]] bool has(const Vec3f& point) const {
        const Vec3f way = point - position_;
        const float depth = way.dot(forward_);
        return depth > 0.0F && std::abs(way.dot(right_)) <= freespace::fixed_shot_tan_across * depth &&
               std::abs(way.dot(up_)) <= freespace::fixed_shot_tan_up * depth;
    }

  private:
    Vec3f position_;
    Vec3f forward_;
    Vec3f right_;
    Vec3f up_;
};

}  // namespace

void Scout::add_player() {
    direction::Take& take = takes.emplace_back();
    take.subject = static_cast<direction::Index>(players.size());
    players.emplace_back();
    looked_at_.emplace_back();
}

void Scout::look(const freespace::Space& space, float unit) {
    const direction::Index self = present[done++];
    direction::PlayerState& player = players[self];
    const std::vector<direction::Index> nearest =
        has_many() ? nearest_to(self) : std::vector<direction::Index>();
    const std::span<const direction::Index> all(has_many() ? nearest : present);
    const Viewpoint eye(space, player.eye);
    for (const direction::Index other : has_many() ? all : all.subspan(done)) {
        if (looked_at_[other][self]) continue;
        looked_at_[self].set(other);
        if (!eye.sees(players[other].eye)) continue;
        player.sees.set(other);
        players[other].sees.set(self);
    }
    look_from_behind(space, unit, self, all);
    look_from_fixed(space, unit, self);
    if (!finished()) return;
    for (direction::Take& take : std::span(takes).first(fixed))
        take.subject = direction::subject_in(take, players);
}

std::vector<direction::Index> Scout::nearest_to(direction::Index self) const {
    std::vector<std::pair<float, direction::Index>> others;
    others.reserve(present.size());
    for (const direction::Index other : present)
        if (other != self) others.emplace_back((players[other].eye - players[self].eye).squaredNorm(), other);
    const auto last = others.begin() + most_looked_at;
    std::ranges::nth_element(others, last);
    std::vector<direction::Index> nearest;
    std::transform(others.begin(), last, std::back_inserter(nearest),
                   [](const auto& other) { return other.second; });
    return nearest;
}

void Scout::look_from_behind(const freespace::Space& space, float unit, direction::Index self,
                             std::span<const direction::Index> others) {
    const direction::PlayerState& player = players[self];
    direction::Take& take = takes[fixed + self];
    const Vec3f behind = player.eye - distance * unit * player.facing;
    const freespace::Space around = is_in_mover(space, player.eye) ? freespace::Space(space.map()) : space;
    const float free = freespace::sight(around, player.eye, behind, clearance * unit).free_length;
    take.position = player.eye - free * player.facing;
    take.shown.set(self);
    take.framed.set(self);
    const Picture picture(take.position, player.facing);
    const Viewpoint camera(space, take.position);
    const auto look_at = [&](direction::Index other, const Vec3f& point) {
        if (!picture.has(point)) return;
        take.framed.set(other);
        if (!take.shown[other] && camera.sees(point)) take.shown.set(other);
    };
    for (const direction::Index other : others) {
        if (other == self) continue;
        look_at(other, players[other].eye);
        look_at(other, centre_below(players[other].eye, unit));
    }
}

void Scout::look_from_fixed(const freespace::Space& space, float unit, direction::Index self) {
    const Vec3f& eye = players[self].eye;
    for (std::size_t i = 0; i < fixed; ++i) {
        const freespace::FixedShot& shot = space.map().fixed_shots()[i];
        direction::Take& take = takes[i];
        take.position = shot.position;
        const auto look_at = [&](const Vec3f& point) {
            if (!freespace::frames(shot, point, unit)) return;
            take.framed.set(self);
            if (!take.shown[self] && freespace::sight(space.map(), shot.position, point).clear &&
                !movers_hide(space, shot.position, point))
                take.shown.set(self);
        };
        look_at(eye);
        look_at(centre_below(eye, unit));
    }
}

}  // namespace camdir::director
