// The moving obstacles of one match: doors, lifts, vehicles. Where they are at any time that is known, and
// what they are in the way of.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "base/error.hpp"
#include "base/geometry.hpp"
#include "freespace/freespace.hpp"
#include "freespace/mover_shape.hpp"

namespace camdir::freespace {

// The mover nearest to a point.
struct MoverDistance {
    // A lower bound of the distance, map units; negative inside. The limit of the question where none is
    // nearer.
    float value = std::numeric_limits<float>::infinity();
    std::uint32_t mover = none;
    Vec3f way_out = Vec3f::Zero();  // the normal of its nearest face, length 1
};

// A sphere's way among the movers.
struct MoverSweep {
    bool clear = true;             // no mover is in the way
    float free_share = 1.0F;       // of the way, 0 .. 1, until one is
    std::uint32_t mover = none;    // that ends it
    Vec3f normal = Vec3f::Zero();  // of the face that ends it, length 1
};

// Const members are thread-safe among each other, do not allocate, and give the same answers for the same
// poses. Times are seconds by the game's clock.
//
// A mover of which no pose is known does not exist, nor does one before its first pose. Between two poses it
// is interpolated. A frame that does not name a mover says that it has not moved since. After the last frame
// a mover that moved in it goes on as it did for `prediction` seconds, then stands.
class Movers {
  public:
    static constexpr double prediction = 0.25;
    // Poses of one mover that are kept: where there are more, the oldest go.
    static constexpr std::size_t most_poses = 1024;

    // Without movers: every question is answered at once.
    Movers() = default;

    // Fails where the shapes exceed the limits of mover_shape.hpp, or where a number of them is out of its
    // range; the message names the mover.
    [[nodiscard]] static Result<Movers> of(std::span<const MoverShape> shapes);

    // Shapes, not poses: a mover's number is less.
    [[nodiscard]] std::size_t count() const { return shapes_.size(); }

    // The poses of a frame, also of one in which none has moved. Returns how many were refused: those of
    // unknown movers, those that are not finite, within +-coordinate_limit and unit quaternions, and all of a
    // frame that is not later than the last one.
    std::size_t add(double time, std::span<const MoverPose> poses);

    // Questions are no longer asked of times before `time`.
    void forget_before(double time);

    // Whether a mover may be in the box, at whatever time: where none is, no other question needs to be
    // asked.
    [[nodiscard]] bool any_near(const Box3f& box) const;

    // Where a mover is; none: nowhere. `mover` < count().
    [[nodiscard]] std::optional<MoverPose> pose_at(std::uint32_t mover, double time) const;

    // The distance of a point from the movers as they are at `time`, if it is less than `limit`. Of a hull
    // the largest signed distance of its half spaces and of its bounds: exact where a face is nearest, less
    // than the distance beyond edges that no half space bevels. A point that is not finite has the distance
    // -infinity.
    [[nodiscard]] MoverDistance distance(const Vec3f& point, double time,
                                         float limit = std::numeric_limits<float>::infinity()) const;

    // A sphere of `radius` (>= 0) on its way between two points, among the movers as they are at `time`.
    // Hulls are grown by shifting their half spaces, so that no sphere that touches one is free. Points that
    // are not finite have no free way, and no mover that ends it.
    [[nodiscard]] MoverSweep sweep(const Vec3f& from, const Vec3f& to, float radius, double time) const;

    // The same, while the movers move: it leaves `from` at the time `since` and comes to `to` at `time`, no
    // earlier. A mover that comes over the sphere is in its way, one that goes ahead of it is not. Exact, but
    // that what turns is taken to go along chords, of at most 0.025 s each.
    [[nodiscard]] MoverSweep sweep(const Vec3f& from, double since, const Vec3f& to, double time,
                                   float radius) const;

    // Where a point that moves with `mover` is at `time`, if it was at `point` at the time `since`.
    [[nodiscard]] Vec3f carried(std::uint32_t mover, const Vec3f& point, double since, double time) const;

  private:
    struct Hull {
        std::uint32_t first;  // of its half spaces
        std::uint32_t end;
        Box3d bounds;
    };
    struct Ball {
        Vec3d centre;
        double radius;
    };
    struct Shape {
        std::uint32_t first_hull, end_hull;
        std::uint32_t first_ball, end_ball;
        Box3f bounds;   // of all, in its own frame
        double radius;  // of a ball about its origin that holds all
    };
    struct Plane {
        Vec3d normal;
        double distance;
    };
    struct Sample {
        double time;
        Vec3f position;
        Quatf orientation;
    };
    // Where a mover is at a time: on its way between two samples, or where both are one.
    struct Stretch {
        const Sample* from;
        const Sample* to;
        float share;  // of the way; more than 1: foreseen

        [[nodiscard]] Vec3f position() const {
            return from->position + share * (to->position - from->position);
        }
        [[nodiscard]] Quatf orientation() const;
    };
    // Rigid: rotates, then moves.
    struct Placement {
        Eigen::Matrix3d rotation;
        Vec3d position;

        [[nodiscard]] Vec3d local(const Vec3d& point) const {
            return rotation.transpose() * (point - position);
        }
    };
    // The closest so far.
    struct Entry {
        double share = std::numeric_limits<double>::infinity();
        Vec3d normal = Vec3d::Zero();  // in the mover's frame
    };
    using Samples = std::vector<Sample>;  // ascending by time

    void add_shape(const MoverShape& shape);
    void append(std::uint32_t mover, const Sample& sample);
    void bound(std::uint32_t mover);
    [[nodiscard]] std::optional<Stretch> stretch_at(std::uint32_t mover, double time) const;
    [[nodiscard]] static Placement placement_of(const Stretch& stretch);
    [[nodiscard]] std::optional<Placement> placement_at(std::uint32_t mover, double time) const;
    // None where a mover is farther than `limit` from the way, or nowhere.
    [[nodiscard]] std::optional<Placement> near_placement_at(std::uint32_t mover, double time,
                                                             const Vec3f& from, const Vec3f& to,
                                                             float limit) const;
    template <class Visitor>
    void for_each_near(const Box3f& box, const Visitor& visit) const;
    void approach(const Shape& shape, const Vec3d& point, double& least, Vec3d& way_out) const;
    void meet(const Shape& shape, const Vec3d& from, const Vec3d& to, double radius, Entry& first) const;
    void meet(const Hull& hull, const Vec3d& from, const Vec3d& to, double radius, Entry& first) const;

    std::vector<Shape> shapes_;
    std::vector<Hull> hulls_;
    std::vector<Ball> balls_;
    std::vector<Plane> planes_;
    std::vector<Samples> samples_;  // by mover
    // Minima, then maxima, of the boxes in which the movers are at any time, for four at once. NaN, which no
    // box touches, are those without a pose and what fills the last four up.
    std::array<std::vector<float>, 6> reach_;
    double newest_ = -std::numeric_limits<double>::infinity();  // time of the last frame
};

}  // namespace camdir::freespace
