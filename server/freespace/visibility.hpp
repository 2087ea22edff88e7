// Visibility along a line of sight: the paper's section 5.2.
#pragma once

#include <array>

#include "freespace/freespace.hpp"
#include "freespace/slab.hpp"

namespace camdir::freespace {

struct Sight {
    bool clear = false;  // the whole segment is proved free, with a sphere of the asked radius around it
    // How far from `from` it is proved free, map units; the segment's length if clear.
    float free_length = 0.0F;
    float clearance = 0.0F;         // lower bound of the clearance along the free part; > 0 when clear
    std::uint32_t triangle = none;  // slab of the last free point
};

// Marches from ball to ball of the representation along the segment, each the one with the largest clearance
// where the last ends. `radius` > 0, map units, asks for a sphere of that radius that is swept along the
// segment, 0 for the line itself. Points that are not finite and radii that are negative or not finite give a
// blocked Sight of free length 0. Thread-safe; may make the octree; deterministic.
//
// What is reported free lies in the slabs, but for a relative rounding of 1e-7. Blocked means not proved
// free: an obstacle, a place that no slab covers, a pinch where no ball carries on by 1 % of the last ball's
// radius (or of the segment's length), or more than 128 balls. `free_length` is 0 only when the free distance
// of `from` does not exceed the radius by more than rounding.
//
// Measured against exact geometry on default bakes of oa_dm1, oa_dm3, oa_rpg3dm2, dm2 and dm3
// (bench-queries): of the free segments of up to 512 units between eyes of matches, or random points, 1.3
// to 2.8 % are reported blocked, none of those whose clearance is at least d0; of the free sweeps of radius 5
// over 120 units 3.5 to 6.1 %; what is reported free always is. Slabs do not reach into every corner: that is
// where it misses.
[[nodiscard]] Sight sight(const Freespace& freespace, const Vec3f& from, const Vec3f& to,
                          float radius = 0.0F);

// The last balls that sights needed, for sights nearby. A value, which belongs to one representation.
class RecentBalls {
  public:
    static constexpr std::size_t capacity = 16;
    RecentBalls() { radius_.fill(-1.0F); }

    // In place of the oldest one. `triangle`: whose slab it is of.
    void add(const Ball& ball, std::uint32_t triangle);

    [[nodiscard]] Ball ball(std::size_t i) const { return {{x_[i], y_[i], z_[i]}, radius_[i]}; }
    [[nodiscard]] std::uint32_t triangle(std::size_t i) const { return triangle_[i]; }

  private:
    friend class BallIntervals;
    // Within the balls that were added, in spite of rounding. A negative radius: none.
    std::array<float, capacity> x_{}, y_{}, z_{}, radius_;
    std::array<std::uint32_t, capacity> triangle_{};
    std::size_t next_ = 0;
};

// The same, by a cheaper march: where recent balls carry on it goes through the one that reaches furthest,
// and asks the octree only where none does. What it finds there becomes recent. It ends where no ball carries
// on by 10 % of the last one's radius (or of the segment's length). What is reported free is as surely free,
// but free length, clearance and triangle may be others than without recent balls. Thread-safe for different
// `recent`.
[[nodiscard]] Sight sight(const Freespace& freespace, const Vec3f& from, const Vec3f& to, float radius,
                          RecentBalls& recent);

// Sights of one radius from one point, which share their first ball. Needs the freespace for as long as it is
// asked.
class SightOrigin {
  public:
    SightOrigin(const Freespace& freespace, const Vec3f& from, float radius);

    // The same as sight() says.
    [[nodiscard]] Sight to(const Vec3f& end) const;

  private:
    const SlabOctree* octree_;
    Vec3f from_;
    float radius_;
    SlabPoint first_;
};

}  // namespace camdir::freespace
