// The free space of a match at an instant: that of the map, less the movers. The queries of distance.hpp and
// visibility.hpp among movers.
#pragma once

#include "freespace/distance.hpp"
#include "freespace/freespace.hpp"
#include "freespace/movers.hpp"
#include "freespace/visibility.hpp"

namespace camdir::freespace {

// A value, which needs the freespace and the movers for as long as it is asked. Thread-safe, while nobody
// changes the movers. Without movers it answers as the freespace alone, at no cost.
class Space {
  public:
    // Nothing moves.
    Space(const Freespace& map) : map_(&map) {}  // NOLINT(google-explicit-constructor)
    // Null, and movers without a shape: nothing moves. The time is that of at().
    Space(const Freespace& map, const Movers* movers)
        : map_(&map), movers_(movers != nullptr && movers->count() != 0 ? movers : nullptr) {}

    // The same at another time, s by the game's clock.
    [[nodiscard]] Space at(double time) const { return in_step(time, time); }
    // The same at `time`, to which a step leads that began at `since`: what lets_pass() asks for.
    [[nodiscard]] Space in_step(double since, double time) const;

    [[nodiscard]] const Freespace& map() const { return *map_; }
    [[nodiscard]] bool has_movers() const { return movers_ != nullptr; }
    [[nodiscard]] double time() const { return time_; }

    // Whether a mover may be in the box, at whatever time.
    [[nodiscard]] bool any_mover_near(const Box3f& box) const {
        return movers_ != nullptr && movers_->any_near(box);
    }
    // The mover nearest to a point, if it is nearer than `limit`.
    [[nodiscard]] MoverDistance mover_distance(const Vec3f& point, float limit) const;
    // A sphere's way among the movers as they are.
    [[nodiscard]] MoverSweep mover_sweep(const Vec3f& from, const Vec3f& to, float radius) const;
    // A point's way of the step among the movers, which move meanwhile.
    [[nodiscard]] MoverSweep step(const Vec3f& from, const Vec3f& to) const;
    [[nodiscard]] bool lets_pass(const Vec3f& from, const Vec3f& to) const { return step(from, to).clear; }
    // Where a point comes to that moves with `mover` in the step.
    [[nodiscard]] Vec3f carried(std::uint32_t mover, const Vec3f& point) const;

    // A sight of the map as far as the movers leave it free. Its clearance is at least the radius then, and
    // may be 0 for radius 0.
    [[nodiscard]] Sight shortened(const Sight& sight, const Vec3f& from, const Vec3f& to, float radius) const;

  private:
    const Freespace* map_;
    const Movers* movers_ = nullptr;
    double since_ = 0.0;
    double time_ = 0.0;
};

// As distance() of the freespace; nothing covers a point in a mover.
[[nodiscard]] Distance distance(const Space& space, const Vec3f& point);

// As sight() of the freespace; a mover ends it. The triangle is that of the map's sight.
[[nodiscard]] Sight sight(const Space& space, const Vec3f& from, const Vec3f& to, float radius = 0.0F);
[[nodiscard]] Sight sight(const Space& space, const Vec3f& from, const Vec3f& to, float radius,
                          RecentBalls& recent);

// Whether sight() says that it is clear, with recent balls or without: the cheaper march is tried first.
[[nodiscard]] bool is_clear(const Space& space, const Vec3f& from, const Vec3f& to, float radius,
                            RecentBalls& recent);

}  // namespace camdir::freespace
