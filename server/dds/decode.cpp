#include "dds/decode.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "freespace/freespace.hpp"
#include "freespace/shape_checks.hpp"

namespace camdir::dds {
namespace {

constexpr float unit_tolerance = 1e-3F;
constexpr std::size_t max_map_name = 255;  // as in the configuration

template <class Sequence>
auto elements(const Sequence& sequence) {
    return std::span(sequence._buffer, sequence._length);
}

bool finite(std::span<const float> values) {
    return std::all_of(values.begin(), values.end(), [](float value) { return std::isfinite(value); });
}

// `quaternions`: finite, x y z w of each.
bool unit_length(std::span<const float> quaternions) {
    for (std::size_t i = 0; i < quaternions.size(); i += 4) {
        const Eigen::Map<const Eigen::Vector4f> quaternion(&quaternions[i]);
        // A norm that overflows to infinity is rejected too.
        if (!(std::abs(quaternion.norm() - 1.0F) <= unit_tolerance)) return false;
    }
    return true;
}

Vec3f vector(std::span<const float> values, std::size_t index) {
    return Vec3f(&values[3 * index]);
}

Quatf quaternion(std::span<const float> values, std::size_t index) {
    return Quatf(&values[4 * index]).normalized();
}

bool distinct(std::span<const std::uint32_t> ids) {
    if (std::ranges::adjacent_find(ids, std::greater_equal()) == ids.end())
        return true;  // as most write them
    std::vector<std::uint32_t> sorted(ids.begin(), ids.end());
    std::ranges::sort(sorted);
    return std::ranges::adjacent_find(sorted) == sorted.end();
}

std::optional<ValidationError> check_player_ids(std::span<const std::uint32_t> ids) {
    if (!std::ranges::all_of(ids, director::is_player_id)) return ValidationError::out_of_range;
    if (!distinct(ids)) return ValidationError::duplicate;
    return std::nullopt;
}

std::optional<ValidationError> check(const camera_director_PoseFrame& sample) {
    const std::size_t count = sample.player_id._length;
    if (count > director::max_players) return ValidationError::too_many;
    if (sample.eye._length != 3 * count || sample.orientation._length != 4 * count ||
        (sample.velocity._length != 3 * count && sample.velocity._length != 0) ||
        sample.flags._length != count ||
        (sample.discontinuities._length != count && sample.discontinuities._length != 0)) {
        return ValidationError::array_length;
    }
    if (!finite(elements(sample.eye)) || !finite(elements(sample.orientation)) ||
        !finite(elements(sample.velocity))) {
        return ValidationError::not_finite;
    }
    if (!unit_length(elements(sample.orientation))) return ValidationError::not_unit;
    return check_player_ids(elements(sample.player_id));
}

std::optional<ValidationError> check(const camera_director_MatchInfo& sample) {
    if (!valid_match_id(sample.match_id)) return ValidationError::bad_match_id;
    if (sample.map_name != nullptr && ::strnlen(sample.map_name, max_map_name + 1) > max_map_name)
        return ValidationError::long_map_name;
    const std::size_t count = sample.player_id._length;
    if (count > director::max_players) return ValidationError::too_many;
    const auto fits = [count](std::size_t length) { return length == count || length == 0; };
    if (!fits(sample.player_name._length) || !fits(sample.player_class._length) ||
        !fits(sample.player_team._length)) {
        return ValidationError::array_length;
    }
    const float numbers[] = {sample.metres_per_unit, sample.rate_hz, sample.spectator_delay_s};
    if (!finite(numbers)) return ValidationError::not_finite;
    if (std::any_of(std::begin(numbers), std::end(numbers), [](float number) { return number < 0.0F; })) {
        return ValidationError::out_of_range;
    }
    return check_player_ids(elements(sample.player_id));
}

std::optional<ValidationError> check(const camera_director_CameraFrame& sample) {
    const std::size_t count = sample.camera_id._length;
    if (count > director::max_cameras || sample.reasons._length > director::max_cameras)
        return ValidationError::too_many;
    if (sample.target._length != count || sample.position._length != 3 * count ||
        sample.orientation._length != 4 * count || sample.vertical_fov._length != count ||
        sample.clearance._length != count || sample.flags._length != count) {
        return ValidationError::array_length;
    }
    if (!finite(elements(sample.position)) || !finite(elements(sample.orientation)) ||
        !finite(elements(sample.vertical_fov)) || !finite(elements(sample.clearance))) {
        return ValidationError::not_finite;
    }
    if (!unit_length(elements(sample.orientation))) return ValidationError::not_unit;
    return std::nullopt;
}

std::optional<ValidationError> check(const camera_director_MoverFrame& sample) {
    const std::size_t count = sample.mover_id._length;
    if (count > freespace::max_movers) return ValidationError::too_many;
    if (sample.position._length != 3 * count || sample.orientation._length != 4 * count)
        return ValidationError::array_length;
    if (!finite(elements(sample.position)) || !finite(elements(sample.orientation)))
        return ValidationError::not_finite;
    if (!unit_length(elements(sample.orientation))) return ValidationError::not_unit;
    if (!distinct(elements(sample.mover_id))) return ValidationError::duplicate;
    return std::nullopt;
}

// Whether the counts, of `owners` or of none, share out `total` elements.
bool shares_out(std::span<const std::uint32_t> counts, std::size_t owners, std::size_t total) {
    const std::uint64_t sum = std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
    return (counts.size() == owners || counts.empty()) && sum == total;
}

bool exceeds(std::span<const std::uint32_t> counts, std::size_t most) {
    return std::ranges::any_of(counts, [most](std::uint32_t count) { return count > most; });
}

std::optional<ValidationError> check_counts(const camera_director_MoverInfo& sample) {
    const std::size_t count = sample.mover_id._length;
    const std::size_t planes = sample.planes._length / 4;
    const std::size_t spheres = sample.spheres._length / 4;
    if (count > freespace::max_movers || planes > director::max_half_spaces ||
        spheres > director::max_balls || exceeds(elements(sample.hulls), freespace::max_hulls) ||
        exceeds(elements(sample.balls), freespace::max_hulls) ||
        exceeds(elements(sample.half_spaces), freespace::max_half_spaces)) {
        return ValidationError::too_many;
    }
    const auto fits = [count](std::size_t length) { return length == count || length == 0; };
    if (!fits(sample.model._length) || !fits(sample.kind._length) || sample.planes._length % 4 != 0 ||
        sample.spheres._length % 4 != 0 ||
        !shares_out(elements(sample.hulls), count, sample.half_spaces._length) ||
        !shares_out(elements(sample.half_spaces), sample.half_spaces._length, planes) ||
        !shares_out(elements(sample.balls), count, spheres)) {
        return ValidationError::array_length;
    }
    return std::nullopt;
}

std::optional<ValidationError> check(const camera_director_MoverInfo& sample) {
    if (const auto error = check_counts(sample)) return error;
    if (!distinct(elements(sample.mover_id))) return ValidationError::duplicate;
    const auto planes = elements(sample.planes);
    const auto spheres = elements(sample.spheres);
    if (!finite(planes) || !finite(spheres)) return ValidationError::not_finite;
    for (std::size_t i = 0; i < planes.size(); i += 4) {
        if (!(std::abs(Vec3f(&planes[i]).norm() - 1.0F) <= unit_tolerance)) return ValidationError::not_unit;
        if (std::abs(planes[i + 3]) > freespace::coordinate_limit) return ValidationError::out_of_range;
    }
    for (std::size_t i = 0; i < spheres.size(); i += 4)
        if (!freespace::is_ball({Vec3f(&spheres[i]), spheres[i + 3]})) return ValidationError::out_of_range;
    return std::nullopt;
}

// The next hull of the sample, whose half spaces are the first of `planes`; takes them off. Without bounds.
freespace::ConvexHull take_hull(std::size_t half_spaces, std::span<const float>& planes) {
    freespace::ConvexHull hull;
    for (std::size_t i = 0; i < half_spaces; ++i, planes = planes.subspan(4))
        hull.half_spaces.push_back({Vec3f(planes.data()).normalized(), planes[3]});
    return hull;
}

}  // namespace

bool valid_match_id(std::string_view match_id) {
    return !match_id.empty() && std::none_of(match_id.begin(), match_id.end(), [](char c) {
        return static_cast<unsigned char>(c) < 0x20 || c == 0x7f ||
               std::string_view("*?/").find(c) != std::string_view::npos;
    });
}

std::optional<ValidationError> decode(const camera_director_MatchInfo& sample, director::MatchInfo& message) {
    if (const auto error = check(sample)) return error;
    message.match_id = sample.match_id;
    message.epoch = sample.epoch;
    message.map_name = sample.map_name != nullptr ? sample.map_name : "";
    message.map_hash = sample.map_hash;
    message.metres_per_unit = sample.metres_per_unit;
    message.rate_hz = sample.rate_hz;
    message.spectator_delay_s = sample.spectator_delay_s;
    message.players.assign(sample.player_id._length, {});
    for (std::uint32_t i = 0; i < sample.player_id._length; ++i) {
        director::Player& player = message.players[i];
        player.id = sample.player_id._buffer[i];
        if (sample.player_name._length != 0) player.name = sample.player_name._buffer[i];
        if (sample.player_class._length != 0) player.player_class = sample.player_class._buffer[i];
        if (sample.player_team._length != 0) player.team = sample.player_team._buffer[i];
    }
    return std::nullopt;
}

std::optional<ValidationError> decode(const camera_director_PoseFrame& sample, director::PoseFrame& message) {
    if (const auto error = check(sample)) return error;
    message.epoch = sample.epoch;
    message.frame_number = sample.frame_number;
    message.frame_time = sample.frame_time;
    message.source_time = sample.source_time;
    message.poses.resize(sample.player_id._length);
    for (std::uint32_t i = 0; i < sample.player_id._length; ++i) {
        director::PlayerPose& pose = message.poses[i];
        pose.player_id = sample.player_id._buffer[i];
        pose.eye = vector(elements(sample.eye), i);
        pose.orientation = quaternion(elements(sample.orientation), i);
        pose.velocity = Vec3f::Zero();
        if (sample.velocity._length != 0) pose.velocity = vector(elements(sample.velocity), i);
        pose.flags = sample.flags._buffer[i];
        pose.discontinuities.reset();
        if (sample.discontinuities._length != 0) pose.discontinuities = sample.discontinuities._buffer[i];
    }
    return std::nullopt;
}

std::optional<ValidationError> decode(const camera_director_MatchEvent& sample,
                                      director::MatchEvent& message) {
    if (!std::isfinite(sample.value)) return ValidationError::not_finite;
    message = {.epoch = sample.epoch,
               .frame_time = sample.frame_time,
               .kind = sample.kind,
               .actor = sample.actor,
               .subject = sample.subject,
               .value = sample.value,
               .detail = sample.detail};
    return std::nullopt;
}

std::optional<ValidationError> decode(const camera_director_MoverInfo& sample, director::MoverInfo& message) {
    if (const auto error = check(sample)) return error;
    message.epoch = sample.epoch;
    message.movers.assign(sample.mover_id._length, {});
    auto half_spaces = elements(sample.half_spaces);
    std::span<const float> planes = elements(sample.planes);
    std::span<const float> spheres = elements(sample.spheres);
    for (std::uint32_t i = 0; i < sample.mover_id._length; ++i) {
        director::Mover& mover = message.movers[i];
        mover.id = sample.mover_id._buffer[i];
        if (sample.model._length != 0) mover.shape.name = sample.model._buffer[i];
        if (sample.kind._length != 0) mover.shape.kind = sample.kind._buffer[i];
        const std::size_t hulls = sample.hulls._length != 0 ? sample.hulls._buffer[i] : 0;
        for (const std::size_t count : half_spaces.first(hulls))
            mover.shape.hulls.push_back(take_hull(count, planes));
        half_spaces = half_spaces.subspan(hulls);
        const std::size_t balls = sample.balls._length != 0 ? sample.balls._buffer[i] : 0;
        for (std::size_t ball = 0; ball < balls; ++ball, spheres = spheres.subspan(4))
            mover.shape.balls.push_back({Vec3f(spheres.data()), spheres[3]});
    }
    return std::nullopt;
}

std::optional<ValidationError> bound_hulls(director::MoverInfo& message, std::size_t most) {
    for (director::Mover& mover : message.movers)
        for (freespace::ConvexHull& hull : mover.shape.hulls) {
            if (!hull.bounds.isEmpty()) continue;
            if (most-- == 0) return std::nullopt;
            const auto bounds = freespace::bounds_of(hull.half_spaces);
            if (!bounds) return ValidationError::bad_hull;
            hull.bounds = *bounds;
        }
    return std::nullopt;
}

bool has_bounds(const director::MoverInfo& message) {
    return std::ranges::none_of(message.movers, [](const director::Mover& mover) {
        return std::ranges::any_of(mover.shape.hulls,
                                   [](const freespace::ConvexHull& hull) { return hull.bounds.isEmpty(); });
    });
}

std::optional<ValidationError> decode(const camera_director_MoverFrame& sample,
                                      director::MoverFrame& message) {
    if (const auto error = check(sample)) return error;
    message.epoch = sample.epoch;
    message.frame_time = sample.frame_time;
    message.source_time = sample.source_time;
    message.poses.resize(sample.mover_id._length);
    for (std::uint32_t i = 0; i < sample.mover_id._length; ++i)
        message.poses[i] = {sample.mover_id._buffer[i], vector(elements(sample.position), i),
                            quaternion(elements(sample.orientation), i)};
    return std::nullopt;
}

std::optional<ValidationError> decode(const camera_director_ObserverRequest& sample,
                                      director::ObserverRequest& message) {
    if (sample.group._length > director::max_players) return ValidationError::too_many;
    const auto group = elements(sample.group);
    message.match_id = sample.match_id;
    message.observer_id = sample.observer_id;
    message.target = sample.target;
    message.group.assign(group.begin(), group.end());
    message.profile = sample.profile;
    message.overrides = sample.overrides;
    message.team = sample.team;
    return std::nullopt;
}

std::optional<ValidationError> decode(const camera_director_CameraFrame& sample,
                                      director::CameraFrame& message) {
    if (const auto error = check(sample)) return error;
    message.epoch = sample.epoch;
    message.frame_number = sample.frame_number;
    message.pose_number = sample.pose_number;
    message.frame_time = sample.frame_time;
    message.source_time = sample.source_time;
    message.cameras.resize(sample.camera_id._length);
    for (std::uint32_t i = 0; i < sample.camera_id._length; ++i) {
        message.cameras[i] = {.camera_id = sample.camera_id._buffer[i],
                              .target = sample.target._buffer[i],
                              .position = vector(elements(sample.position), i),
                              .orientation = quaternion(elements(sample.orientation), i),
                              .vertical_fov = sample.vertical_fov._buffer[i],
                              .clearance = sample.clearance._buffer[i],
                              .flags = sample.flags._buffer[i]};
    }
    message.reasons.clear();
    for (const camera_director_ShotReason& reason : elements(sample.reasons))
        message.reasons.push_back({reason.camera_id, {reason.actor, reason.subject, reason.why}});
    return std::nullopt;
}

std::optional<ValidationError> decode(const camera_director_DirectorSign& sample, Sign& sign) {
    if (sample.term > max_term || sample.rank > max_rank || sample.lease_ms == 0 ||
        sample.lease_ms > max_lease.count()) {
        return ValidationError::out_of_range;
    }
    sign = {sample.director_id, sample.term,        sample.rank, std::chrono::milliseconds(sample.lease_ms),
            sample.leads,       sample.has_cameras, sample.shard};
    return std::nullopt;
}

}  // namespace camdir::dds
