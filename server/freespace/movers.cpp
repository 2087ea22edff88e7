#include "freespace/movers.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <string>
#include <unordered_set>

#include "base/float4.hpp"
#include "base/round_down.hpp"

namespace camdir::freespace {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double rounding = 1e-5;          // of lengths
constexpr float length_tolerance = 1e-3F;  // of what should have length 1
// Movements between frames further apart than this say nothing about what comes after, s.
constexpr double longest_frame = 0.25;
// While both move, a way is looked at in parts of at most this time, s, but not in more than so many.
constexpr double part_time = 0.025;
constexpr double most_parts = 10.0;

bool is_coordinate(const Vec3f& point) {
    return point.allFinite() && point.cwiseAbs().maxCoeff() <= coordinate_limit;
}

bool has_length_1(float squared_length) {
    return std::abs(squared_length - 1.0F) <= length_tolerance;
}

bool is_usable(const HalfSpace& half_space) {
    return has_length_1(half_space.normal.squaredNorm()) && std::abs(half_space.distance) <= coordinate_limit;
}

bool is_usable(const MoverPose& pose) {
    return is_coordinate(pose.position) && has_length_1(pose.orientation.squaredNorm());
}

// What is wrong with it; empty: nothing.
std::string fault_of(const ConvexHull& hull) {
    if (hull.half_spaces.size() < 4 || hull.half_spaces.size() > max_half_spaces)
        return std::to_string(hull.half_spaces.size()) + " half spaces, expected 4 to " +
               std::to_string(max_half_spaces);
    if (!std::all_of(hull.half_spaces.begin(), hull.half_spaces.end(),
                     [](const HalfSpace& each) { return is_usable(each); }))
        return "a half space without a normal of length 1 or with a distance out of range";
    if (!is_coordinate(hull.bounds.min()) || !is_coordinate(hull.bounds.max()) || hull.bounds.isEmpty())
        return "bounds that are empty or out of range";
    return {};
}

std::string fault_of(const MoverShape& shape) {
    if (shape.hulls.size() > max_hulls || shape.balls.size() > max_hulls)
        return std::to_string(shape.hulls.size()) + " hulls and " + std::to_string(shape.balls.size()) +
               " balls, expected at most " + std::to_string(max_hulls) + " of each";
    for (std::size_t i = 0; i < shape.hulls.size(); ++i)
        if (const std::string fault = fault_of(shape.hulls[i]); !fault.empty())
            return "hull " + std::to_string(i) + " has " + fault;
    for (std::size_t i = 0; i < shape.balls.size(); ++i)
        if (!is_coordinate(shape.balls[i].centre) || !(shape.balls[i].radius > 0.0F) ||
            shape.balls[i].radius > coordinate_limit)
            return "ball " + std::to_string(i) + " has a centre or a radius out of range";
    return {};
}

bool same_place(const Vec3f& position, const Quatf& orientation, const MoverPose& pose) {
    return position == pose.position && orientation.coeffs() == pose.orientation.coeffs();
}

// Signed distance of the point from the box: exact outside.
double distance_of(const Box3d& box, const Vec3d& point) {
    const Vec3d outside = (box.min() - point).cwiseMax(point - box.max());
    const double depth = outside.maxCoeff();
    return depth > 0.0 ? outside.cwiseMax(0.0).norm() : depth;
}

double distance_from_way(const Vec3d& point, const Vec3d& from, const Vec3d& to) {
    const Vec3d way = to - from;
    const double squared = way.squaredNorm();
    const double share = squared > 0.0 ? std::clamp(way.dot(point - from) / squared, 0.0, 1.0) : 0.0;
    return (from + share * way - point).norm();
}

Vec3d way_out_of(const Box3d& box, const Vec3d& point) {
    const Vec3d below = box.min() - point;
    const Vec3d above = point - box.max();
    int axis = 0;
    const double depth = below.cwiseMax(above).maxCoeff(&axis);
    return (below[axis] == depth ? -1.0 : 1.0) * Vec3d::Unit(axis);
}

// The part of a segment that is inside of planes.
class Clip {
  public:
    // By the signed distances of its ends from a plane and its normal. False: nothing is left.
    bool by(double from, double to, const Vec3d& normal) {
        if (from > 0.0 && to > 0.0) return false;
        if (from > 0.0) {
            const double share = from / (from - to);
            if (share > enter_) {
                enter_ = share;
                normal_ = normal;
            }
        } else {
            if (from > nearest_) {
                nearest_ = from;
                nearest_normal_ = normal;
            }
            if (to > 0.0) leave_ = std::min(leave_, from / (from - to));
        }
        return enter_ <= leave_;
    }

    [[nodiscard]] double enter() const { return enter_; }
    // Of the plane by which it enters; where it begins inside, of the one nearest to its beginning.
    [[nodiscard]] const Vec3d& normal() const { return enter_ > 0.0 ? normal_ : nearest_normal_; }

  private:
    double enter_ = 0.0;
    double leave_ = 1.0;
    Vec3d normal_ = Vec3d::Zero();
    double nearest_ = -infinite;
    Vec3d nearest_normal_ = Vec3d::Zero();
};

}  // namespace

Result<Movers> Movers::of(std::span<const MoverShape> shapes) {
    if (shapes.size() > max_movers)
        return fail("a map with " + std::to_string(shapes.size()) + " movers, expected at most " +
                    std::to_string(max_movers));
    Movers movers;
    std::unordered_set<std::string> names;
    for (const MoverShape& shape : shapes) {
        std::string fault = fault_of(shape);
        if (fault.empty() && !names.insert(shape.name).second) fault = "the name of another one";
        if (!fault.empty()) return fail("mover \"" + shape.name + "\": " + fault);
        movers.add_shape(shape);
    }
    const std::size_t padded = (shapes.size() + lane_count - 1) / lane_count * lane_count;
    for (std::vector<float>& side : movers.reach_)
        side.assign(padded, std::numeric_limits<float>::quiet_NaN());
    return movers;
}

void Movers::add_shape(const MoverShape& shape) {
    const auto size_of = [](const auto& list) { return static_cast<std::uint32_t>(list.size()); };
    Shape added{size_of(hulls_), 0, size_of(balls_), 0, {}, 0.0};
    for (const ConvexHull& hull : shape.hulls) {
        const std::uint32_t first = size_of(planes_);
        for (const HalfSpace& half_space : hull.half_spaces) {
            const Vec3d normal = half_space.normal.cast<double>();
            planes_.push_back({normal / normal.norm(), half_space.distance / normal.norm()});
        }
        hulls_.push_back({first, size_of(planes_), hull.bounds.cast<double>()});
        added.bounds.extend(hull.bounds);
    }
    for (const MoverBall& ball : shape.balls) {
        balls_.push_back({ball.centre.cast<double>(), ball.radius});
        added.bounds.extend(Box3f(ball.centre.array() - ball.radius, ball.centre.array() + ball.radius));
    }
    if (!added.bounds.isEmpty())
        added.radius =
            added.bounds.min().cwiseAbs().cwiseMax(added.bounds.max().cwiseAbs()).cast<double>().norm();
    added.end_hull = size_of(hulls_);
    added.end_ball = size_of(balls_);
    shapes_.push_back(added);
    samples_.emplace_back();
}

std::size_t Movers::add(double time, std::span<const MoverPose> poses) {
    if (!std::isfinite(time) || time <= newest_) return poses.size();
    const double before = newest_;
    newest_ = time;
    std::size_t refused = 0;
    for (const MoverPose& pose : poses) {
        if (pose.mover >= count() || !is_usable(pose)) {
            ++refused;
            continue;
        }
        const Samples& known = samples_[pose.mover];
        if (!known.empty() && known.back().time < before) {
            Sample stood = known.back();
            stood.time = before;
            append(pose.mover, stood);
        }
        append(pose.mover, {time, pose.position, pose.orientation});
        bound(pose.mover);
    }
    return refused;
}

// While a mover stands, its first and its last pose are enough.
void Movers::append(std::uint32_t mover, const Sample& sample) {
    Samples& known = samples_[mover];
    if (!known.empty() && known.back().time == sample.time) known.pop_back();
    const MoverPose pose{mover, sample.position, sample.orientation};
    const std::size_t size = known.size();
    const bool stands = size >= 2 &&
                        same_place(known[size - 1].position, known[size - 1].orientation, pose) &&
                        same_place(known[size - 2].position, known[size - 2].orientation, pose);
    if (stands) {
        known.back().time = sample.time;
        return;
    }
    if (size == most_poses) known.erase(known.begin(), known.begin() + most_poses / 2);
    known.push_back(sample);
}

void Movers::forget_before(double time) {
    for (std::uint32_t mover = 0; mover < count(); ++mover) {
        Samples& known = samples_[mover];
        const auto later = std::upper_bound(known.begin(), known.end(), time,
                                            [](double at, const Sample& sample) { return at < sample.time; });
        // The one before goes on to say where the mover is.
        if (later - known.begin() < 2) continue;
        known.erase(known.begin(), later - 1);
        bound(mover);
    }
}

// Sets the box in which the mover is at any time.
void Movers::bound(std::uint32_t mover) {
    const Samples& known = samples_[mover];
    Box3f positions;
    bool turns = false;
    for (const Sample& sample : known) {
        positions.extend(sample.position);
        turns = turns || sample.orientation.coeffs() != known.front().orientation.coeffs();
    }
    if (const auto last = stretch_at(mover, known.back().time + prediction))
        positions.extend(last->position());
    const Box3f& bounds = shapes_[mover].bounds;
    if (bounds.isEmpty()) return;
    Box3f reach;
    if (turns) {
        const float radius = bounds.min().cwiseAbs().cwiseMax(bounds.max().cwiseAbs()).norm();
        reach = Box3f(positions.min().array() - radius, positions.max().array() + radius);
    } else {
        Box3f turned;
        for (int corner = 0; corner < 8; ++corner)
            turned.extend(known.front().orientation * bounds.corner(static_cast<Box3f::CornerType>(corner)));
        reach = Box3f(positions.min() + turned.min(), positions.max() + turned.max());
    }
    // Rounding must not make it too small.
    const Vec3f size = reach.min().cwiseAbs().cwiseMax(reach.max().cwiseAbs());
    const Vec3f margin = Vec3f::Constant(0.01F) + 1e-5F * size;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto i = static_cast<Eigen::Index>(axis);
        reach_[axis][mover] = reach.min()[i] - margin[i];
        reach_[axis + 3][mover] = reach.max()[i] + margin[i];
    }
}

std::optional<Movers::Stretch> Movers::stretch_at(std::uint32_t mover, double time) const {
    const Samples& known = samples_[mover];
    const auto later = std::upper_bound(known.begin(), known.end(), time,
                                        [](double at, const Sample& sample) { return at < sample.time; });
    if (later == known.begin()) return std::nullopt;
    const Sample& last = *(later - 1);
    const Stretch stands{&last, &last, 0.0F};
    const bool foreseen = later == known.end();
    if (foreseen && (last.time < newest_ || later - known.begin() < 2)) return stands;
    const Sample& from = foreseen ? *(later - 2) : last;
    const Sample& to = foreseen ? last : *later;
    const double frame = to.time - from.time;
    if (foreseen && frame > longest_frame) return stands;
    const double at = foreseen ? std::min(time, to.time + prediction) : time;
    return Stretch{&from, &to, static_cast<float>((at - from.time) / frame)};
}

Quatf Movers::Stretch::orientation() const {
    if (from->orientation.coeffs() == to->orientation.coeffs()) return to->orientation;
    const Eigen::AngleAxisf turn(to->orientation * from->orientation.conjugate());
    const Quatf turned(Eigen::AngleAxisf(share * turn.angle(), turn.axis()));
    return (turned * from->orientation).normalized();
}

std::optional<MoverPose> Movers::pose_at(std::uint32_t mover, double time) const {
    const auto stretch = stretch_at(mover, time);
    if (!stretch) return std::nullopt;
    return MoverPose{mover, stretch->position(), stretch->orientation()};
}

Movers::Placement Movers::placement_of(const Stretch& stretch) {
    return {stretch.orientation().cast<double>().normalized().toRotationMatrix(),
            stretch.position().cast<double>()};
}

std::optional<Movers::Placement> Movers::placement_at(std::uint32_t mover, double time) const {
    const auto stretch = stretch_at(mover, time);
    if (!stretch) return std::nullopt;
    return placement_of(*stretch);
}

// Most of the movers that may be near at some time are far away now: which way they are turned need not be
// known.
std::optional<Movers::Placement> Movers::near_placement_at(std::uint32_t mover, double time,
                                                           const Vec3f& from, const Vec3f& to,
                                                           float limit) const {
    const auto stretch = stretch_at(mover, time);
    if (!stretch) return std::nullopt;
    const Vec3d centre = stretch->position().cast<double>();
    const double reach = (1.0 + rounding) * (shapes_[mover].radius + static_cast<double>(limit)) +
                         rounding * centre.cwiseAbs().maxCoeff();
    if (distance_from_way(centre, from.cast<double>(), to.cast<double>()) > reach) return std::nullopt;
    return placement_of(*stretch);
}

// Visits those whose reach touches the box.
template <class Visitor>
void Movers::for_each_near(const Box3f& box, const Visitor& visit) const {
    const auto& [min_x, min_y, min_z, max_x, max_y, max_z] = reach_;
    for (std::size_t i = 0; i < min_x.size(); i += lane_count) {
        const Mask4 near = (load(&min_x[i]) <= box.max().x()) & (load(&max_x[i]) >= box.min().x()) &
                           (load(&min_y[i]) <= box.max().y()) & (load(&max_y[i]) >= box.min().y()) &
                           (load(&min_z[i]) <= box.max().z()) & (load(&max_z[i]) >= box.min().z());
        for (unsigned left = bits(near); left != 0; left &= left - 1)
            visit(static_cast<std::uint32_t>(i) + static_cast<std::uint32_t>(std::countr_zero(left)));
    }
}

bool Movers::any_near(const Box3f& box) const {
    bool any = false;
    for_each_near(box, [&](std::uint32_t) { any = true; });
    return any;
}

MoverDistance Movers::distance(const Vec3f& point, double time, float limit) const {
    MoverDistance nearest;
    nearest.value = limit;
    if (!point.allFinite()) {
        nearest.value = -std::numeric_limits<float>::infinity();
        return nearest;
    }
    double least = limit;
    const float around = std::max(limit, 0.0F);
    for_each_near(Box3f(point.array() - around, point.array() + around), [&](std::uint32_t mover) {
        const auto placement = near_placement_at(mover, time, point, point, around);
        if (!placement) return;
        const double before = least;
        Vec3d way_out;
        approach(shapes_[mover], placement->local(point.cast<double>()), least, way_out);
        if (least == before) return;
        nearest = {round_down(least), mover, (placement->rotation * way_out).cast<float>()};
    });
    return nearest;
}

void Movers::approach(const Shape& shape, const Vec3d& point, double& least, Vec3d& way_out) const {
    for (std::uint32_t i = shape.first_hull; i < shape.end_hull; ++i) {
        const Hull& hull = hulls_[i];
        double distance = distance_of(hull.bounds, point);
        if (distance >= least) continue;
        Vec3d normal = way_out_of(hull.bounds, point);
        for (std::uint32_t k = hull.first; k < hull.end && distance < least; ++k) {
            const double of_plane = planes_[k].normal.dot(point) - planes_[k].distance;
            if (of_plane < distance) continue;
            distance = of_plane;
            normal = planes_[k].normal;
        }
        if (distance >= least) continue;
        least = distance;
        way_out = normal;
    }
    for (std::uint32_t i = shape.first_ball; i < shape.end_ball; ++i) {
        const Vec3d out = point - balls_[i].centre;
        const double distance = out.norm() - balls_[i].radius;
        if (distance >= least) continue;
        least = distance;
        way_out = out.norm() > 0.0 ? Vec3d(out.normalized()) : Vec3d(Vec3d::UnitZ());
    }
}

MoverSweep Movers::sweep(const Vec3f& from, const Vec3f& to, float radius, double time) const {
    return sweep(from, time, to, time, radius);
}

MoverSweep Movers::sweep(const Vec3f& from, double since, const Vec3f& to, double time, float radius) const {
    MoverSweep first;
    if (!from.allFinite() || !to.allFinite()) {
        first.clear = false;
        first.free_share = 0.0F;
        return first;
    }
    Box3f box(from.cwiseMin(to), from.cwiseMax(to));
    box.min().array() -= radius;
    box.max().array() += radius;
    const int parts = static_cast<int>(std::clamp(std::ceil((time - since) / part_time), 1.0, most_parts));
    double least = infinite;
    for_each_near(box, [&](std::uint32_t mover) {
        auto before =
            since == time ? near_placement_at(mover, time, from, to, radius) : placement_at(mover, since);
        for (int part = 1; part <= parts; ++part) {
            const double begin = static_cast<double>(part - 1) / parts;
            const double end = static_cast<double>(part) / parts;
            const auto after = since == time ? before : placement_at(mover, since + end * (time - since));
            // It may come into being meanwhile.
            const auto& at_begin = before ? before : after;
            if (after) {
                const Vec3d way = (to - from).cast<double>();
                Entry entry;
                meet(shapes_[mover], at_begin->local(from.cast<double>() + begin * way),
                     after->local(from.cast<double>() + end * way), radius, entry);
                const double share = begin + entry.share * (end - begin);
                if (share < least) {
                    least = share;
                    first = {false, round_down(share), mover, (after->rotation * entry.normal).cast<float>()};
                }
            }
            before = after;
        }
    });
    return first;
}

void Movers::meet(const Shape& shape, const Vec3d& from, const Vec3d& to, double radius, Entry& first) const {
    for (std::uint32_t i = shape.first_hull; i < shape.end_hull; ++i)
        meet(hulls_[i], from, to, radius, first);
    for (std::uint32_t i = shape.first_ball; i < shape.end_ball; ++i) {
        const Vec3d out = from - balls_[i].centre;
        const Vec3d way = to - from;
        const double reach = balls_[i].radius + radius;
        const double gap = out.squaredNorm() - reach * reach;
        double share = 0.0;
        if (gap > 0.0) {
            const double towards = -out.dot(way);
            const double root = towards * towards - way.squaredNorm() * gap;
            if (towards <= 0.0 || root < 0.0) continue;
            share = gap / (towards + std::sqrt(root));
            if (share > 1.0) continue;
        }
        if (share >= first.share) continue;
        const Vec3d normal = out + share * way;
        first = {share, normal.norm() > 0.0 ? Vec3d(normal.normalized()) : Vec3d(Vec3d::UnitZ())};
    }
}

void Movers::meet(const Hull& hull, const Vec3d& from, const Vec3d& to, double radius, Entry& first) const {
    Clip clip;
    for (int axis = 0; axis < 3; ++axis) {
        const double below = hull.bounds.min()[axis] - radius;
        const double above = hull.bounds.max()[axis] + radius;
        if (!clip.by(below - from[axis], below - to[axis], -Vec3d::Unit(axis)) ||
            !clip.by(from[axis] - above, to[axis] - above, Vec3d::Unit(axis)))
            return;
    }
    for (std::uint32_t i = hull.first; i < hull.end; ++i) {
        const auto& [normal, distance] = planes_[i];
        const double reach = distance + radius;
        if (!clip.by(normal.dot(from) - reach, normal.dot(to) - reach, normal)) return;
    }
    if (clip.enter() < first.share) first = {clip.enter(), clip.normal()};
}

Vec3f Movers::carried(std::uint32_t mover, const Vec3f& point, double since, double time) const {
    const auto before = placement_at(mover, since);
    const auto after = placement_at(mover, time);
    if (!before || !after) return point;
    return (after->rotation * before->local(point.cast<double>()) + after->position).cast<float>();
}

}  // namespace camdir::freespace
