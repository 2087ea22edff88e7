#include "camera/beams.hpp"

#include <algorithm>
#include <cmath>

#include "camera/reach.hpp"
#include "freespace/slab.hpp"

namespace camdir::camera {
namespace {

constexpr float beam_share = 4.0F / 3.0F;  // radius against the camera's minimum clearance
constexpr float inside_eye_ball = 0.9F;
constexpr float cell_size = 20.0F;  // units

float widest(const MapProfile& profile) {
    return beam_share * profile.minimum_clearance;
}

}  // namespace

void FreeBeams::advance(std::size_t count) {
    for (std::size_t i = 0; i < std::min(count, beams_.size()); ++i)
        of_sample(i) = {};
    first_ += count;
}

void FreeLengths::use(float longest, float radius) {
    if (longest == longest_ && radius == radius_) return;
    *this = {};
    longest_ = longest;
    radius_ = radius;
}

float& FreeLengths::at(const Vec3f& eye, std::size_t bin, float cell) {
    std::uint64_t hash = 1;
    const auto mix = [&hash](std::uint64_t value) {
        hash = (hash ^ value) * 0x9e3779b97f4a7c15U;
        hash ^= hash >> 32U;
    };
    for (const float coordinate : eye)
        mix(static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(coordinate / cell))));
    // Directions beside each other are asked for together: they lie beside each other.
    Entry& entry = entries_[(hash + bin) % entries_.size()];
    const auto tag = static_cast<std::uint32_t>((hash >> 32U) + bin);
    if (entry.tag != tag) entry = {tag, -1.0F};
    return entry.length;
}

Beams::Beams(const freespace::Space& space, const MapProfile& profile, const Future& future, FreeBeams& known,
             FreeLengths& lengths, freespace::RecentBalls& balls)
    : space_(space), profile_(profile), future_(future), known_(known), lengths_(lengths), balls_(balls) {
    std::fill_n(radius_.begin(), future.count, -1.0F);
    lengths_.use(profile.distance, profile.minimum_clearance);
    has_movers_ = space.has_movers() && space.any_mover_near(box_of_beams());
}

Box3f Beams::box_of_beams() const {
    Box3f box;
    for (std::size_t i = 0; i < future_.count; ++i)
        box.extend(future_[i].eye);
    const float reach = profile_.distance + widest(profile_);
    return {box.min().array() - reach, box.max().array() + reach};
}

float Beams::radius(std::size_t i) {
    if (radius_[i] < 0.0F) radius_[i] = radius_from(future_[i].eye);
    return radius_[i];
}

float Beams::radius_from(const Vec3f& eye) {
    const float widest_radius = widest(profile_);
    // Between two places clearance changes by no more than their distance.
    const float least_clearance = clearance_ - (eye - clear_eye_).norm();
    if (inside_eye_ball * least_clearance >= widest_radius) return widest_radius;
    clear_eye_ = eye;
    clearance_ = freespace::distance(space_.map(), eye).value;
    return std::max(0.0F, std::min(widest_radius, inside_eye_ball * clearance_));
}

freespace::Sight Beams::sight(std::size_t i, const Vec3f& goal) {
    return freespace::sight(space_.map(), future_[i].eye, goal, radius(i), balls_);
}

float Beams::length_on_map(std::size_t i, const Vec3f& direction, float length) {
    const Vec3f& eye = future_[i].eye;
    const freespace::Sight beam = sight(i, eye + length * direction);
    return beam.clear ? length : std::max(0.0F, beam.free_length - inside_beam * profile_.unit);
}

std::optional<BeamEnd> Beams::end_at_mover(std::size_t i, const Vec3f& direction, float length) {
    if (!has_movers_ && (!space_.has_movers() || length <= profile_.distance)) return std::nullopt;
    const freespace::Space then = space_.at(future_.start + static_cast<double>(i) * future_.step);
    const Vec3f& eye = future_[i].eye;
    const Vec3f goal = eye + length * direction;
    freespace::MoverSweep beam = then.mover_sweep(eye, goal, widest(profile_));
    if (beam.clear) return std::nullopt;
    // No wider than the eye's own distance from them.
    const float around_eye = inside_eye_ball * then.mover_distance(eye, widest(profile_)).value;
    beam = then.mover_sweep(eye, goal, std::clamp(around_eye, 0.0F, radius(i)));
    if (beam.clear) return std::nullopt;
    return BeamEnd{std::max(0.0F, beam.free_share * length - inside_beam * profile_.unit), -beam.normal};
}

float Beams::length_among_movers(std::size_t i, const Vec3f& direction, float length) {
    const auto end = end_at_mover(i, direction, length);
    return end ? end->free_length : length;
}

float Beams::free_length(std::size_t i, const Vec3f& direction, float length) {
    return length_among_movers(i, direction, length_on_map(i, direction, length));
}

float Beams::free_length(std::size_t i, std::size_t bin) {
    const Vec3f& direction = DirectionGrid::directions()[bin];
    float& length = lengths_.at(future_[i].eye, bin, cell_size * profile_.unit);
    if (length < 0.0F) length = length_on_map(i, direction, profile_.distance);
    return length_among_movers(i, direction, length);
}

std::optional<BeamEnd> Beams::end(std::size_t i, const Vec3f& direction, float length) {
    const auto on_map = end_on_map(i, direction, length);
    const auto at_mover = end_at_mover(i, direction, on_map ? on_map->free_length : length);
    return at_mover ? at_mover : on_map;
}

std::optional<BeamEnd> Beams::end_on_map(std::size_t i, const Vec3f& direction, float length) {
    const Vec3f& eye = future_[i].eye;
    const Vec3f goal = eye + length * direction;
    FreeBeam& known = known_.of_sample(i);
    if (known.covers(eye, goal, widest(profile_)) || known.covers(eye, goal, radius(i))) return std::nullopt;
    const freespace::Sight beam = sight(i, goal);
    if (beam.clear) {
        known = {eye, goal, beam.clearance};
        return std::nullopt;
    }
    BeamEnd end{std::max(0.0F, beam.free_length - inside_beam * profile_.unit), direction};
    if (beam.triangle == freespace::none) return end;
    const Vec3f point = eye + beam.free_length * direction;
    freespace::SlabPoint last;
    freespace::improve_range(space_.map().mesh(), point, beam.triangle, 1, last);
    if (last.triangle == freespace::none) return end;
    const Vec3d out = point.cast<double>() - freespace::ball_at(space_.map().mesh(), last).centre;
    if (out.norm() > 0.0) end.normal = out.normalized().cast<float>();
    return end;
}

}  // namespace camdir::camera
