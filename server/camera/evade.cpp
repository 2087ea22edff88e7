#include "camera/evade.hpp"

#include <algorithm>
#include <array>

namespace camdir::camera {
namespace {

constexpr std::array moments = {0.0, 0.08, 0.16, 0.25};  // s from now
constexpr float beyond_clearance = 1.01F;
constexpr std::array ways = {0.5F, 1.0F, 2.0F, 4.0F, 8.0F};  // in clearances

// The choice among places that can be reached.
class Refuge {
  public:
    Refuge(const freespace::Space& space, const Vec3f& place, float clearance, float limit)
        : space_(space), place_(place), clearance_(clearance), limit_(limit) {}

    void consider(const Vec3f& target) {
        const float way = (target - place_).norm();
        if (way > limit_) return;
        const freespace::Distance free = freespace::distance(space_, target);
        if (!free.covered()) return;
        const float room = room_soon(space_, target, std::min(free.value, clearance_));
        const bool is_better = !best_ || room > room_ || (room == room_ && way < way_);
        if (!is_better || !can_reach(target, way, free.value)) return;
        best_ = target;
        room_ = room;
        way_ = way;
    }
    [[nodiscard]] const std::optional<Vec3f>& best() const { return best_; }

  private:
    [[nodiscard]] bool can_reach(const Vec3f& target, float way, float clearance) const {
        return (way < freespace::surely_inside * clearance ||
                freespace::sight(space_.map(), place_, target).clear) &&
               space_.lets_pass(place_, target);
    }

    const freespace::Space& space_;
    Vec3f place_;
    float clearance_;
    float limit_;
    std::optional<Vec3f> best_;
    float room_ = 0.0F;
    float way_ = 0.0F;
};

}  // namespace

float room_soon(const freespace::Space& space, const Vec3f& place, float clearance) {
    const Vec3f around = Vec3f::Constant(std::max(clearance, 0.0F));
    if (!space.any_mover_near({place - around, place + around})) return clearance;
    float room = clearance;
    for (const double moment : moments)
        room = space.at(space.time() + moment).mover_distance(place, room).value;
    return room;
}

bool is_threatened(const freespace::Space& space, const Vec3f& place, float clearance) {
    return space.has_movers() &&
           (room_soon(space, place, clearance) < clearance || !space.lets_pass(place, place));
}

Vec3f pushed(const freespace::Space& space, const Vec3f& place, float clearance) {
    if (!space.has_movers()) return place;
    const freespace::MoverSweep overtaken = space.step(place, place);
    const freespace::MoverDistance near = space.mover_distance(place, clearance);
    const std::uint32_t mover = overtaken.clear ? near.mover : overtaken.mover;
    if (mover == freespace::none) return place;
    const Vec3f ahead = space.carried(mover, place);
    const freespace::MoverDistance left = space.mover_distance(ahead, clearance);
    return ahead + (beyond_clearance * clearance - left.value) * left.way_out;
}

std::optional<Vec3f> evade(const freespace::Space& space, const Vec3f& place, float clearance, float limit) {
    Refuge refuge(space, place, clearance, limit);
    refuge.consider(place);
    refuge.consider(pushed(space, place, clearance));
    for (int x = -1; x <= 1; ++x)
        for (int y = -1; y <= 1; ++y)
            for (int z = -1; z <= 1; ++z) {
                const Vec3f direction =
                    Vec3f(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)).normalized();
                for (const float way : ways)
                    refuge.consider(place + way * clearance * direction);
            }
    return refuge.best();
}

}  // namespace camdir::camera
