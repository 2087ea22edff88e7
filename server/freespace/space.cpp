#include "freespace/space.hpp"

#include <algorithm>

namespace camdir::freespace {

Space Space::in_step(double since, double time) const {
    Space space = *this;
    space.since_ = std::min(since, time);
    space.time_ = time;
    return space;
}

MoverDistance Space::mover_distance(const Vec3f& point, float limit) const {
    if (movers_ == nullptr) return {limit};
    return movers_->distance(point, time_, limit);
}

MoverSweep Space::mover_sweep(const Vec3f& from, const Vec3f& to, float radius) const {
    if (movers_ == nullptr) return {};
    return movers_->sweep(from, to, radius, time_);
}

MoverSweep Space::step(const Vec3f& from, const Vec3f& to) const {
    if (movers_ == nullptr) return {};
    return movers_->sweep(from, since_, to, time_, 0.0F);
}

Vec3f Space::carried(std::uint32_t mover, const Vec3f& point) const {
    return movers_->carried(mover, point, since_, time_);
}

Sight Space::shortened(const Sight& sight, const Vec3f& from, const Vec3f& to, float radius) const {
    if (movers_ == nullptr || sight.triangle == none) return sight;
    const Vec3f end = sight.clear ? to : Vec3f(from + sight.free_length * (to - from).normalized());
    if (mover_sweep(from, end, std::max(sight.clearance, radius)).clear) return sight;
    const MoverSweep swept = mover_sweep(from, end, radius);
    Sight left = sight;
    left.clear = sight.clear && swept.clear;
    left.free_length *= swept.free_share;
    left.clearance = radius;
    return left;
}

Distance distance(const Space& space, const Vec3f& point) {
    Distance found = distance(space.map(), point);
    if (!space.has_movers() || !found.covered()) return found;
    found.value = space.mover_distance(point, found.value).value;
    return found.covered() ? found : Distance{};
}

Sight sight(const Space& space, const Vec3f& from, const Vec3f& to, float radius) {
    return space.shortened(sight(space.map(), from, to, radius), from, to, radius);
}

Sight sight(const Space& space, const Vec3f& from, const Vec3f& to, float radius, RecentBalls& recent) {
    return space.shortened(sight(space.map(), from, to, radius, recent), from, to, radius);
}

bool is_clear(const Space& space, const Vec3f& from, const Vec3f& to, float radius, RecentBalls& recent) {
    Sight of_map = sight(space.map(), from, to, radius, recent);
    if (!of_map.clear) of_map = sight(space.map(), from, to, radius);
    return of_map.clear && space.shortened(of_map, from, to, radius).clear;
}

}  // namespace camdir::freespace
