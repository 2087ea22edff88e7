#include "camera/spot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "camera/reach.hpp"
#include "camera/view.hpp"

namespace camdir::camera {
namespace {

constexpr float yaw_step = 15.0F * radians_of_a_degree<float>;
constexpr int yaw_steps = 12;  // to each side
constexpr std::array elevations = {0.0F * radians_of_a_degree<float>, 20.0F * radians_of_a_degree<float>,
                                   -20.0F * radians_of_a_degree<float>, 45.0F * radians_of_a_degree<float>};
constexpr float leave_cost = 0.2F;     // of leaving the camera's direction, against angle's own
constexpr float fan_interval = 0.06F;  // s
constexpr float cut_distance_weight = 2.0F;
constexpr float right_angle = std::numbers::pi_v<float> / 2.0F;
// Nearer to the line the picture could be from either side: the players move.
constexpr float beside_line = 5.0F * radians_of_a_degree<float>;

// How far the camera trails behind a turning player: what its filters delay.
float lag(const MapProfile& profile) {
    return profile.heading_smoothing + 2.0F * profile.motion_smoothing;
}

// Directions from the anchor that lead to the camera's side of the line of action, seen from above.
class Side {
  public:
    Side(const LineOfAction& line, const Vec3f& anchor)
        : line_(anchor - line.other), sign_(left_of_line(line.camera - line.other) < 0.0F ? -1.0F : 1.0F) {}

    [[nodiscard]] bool has(const Vec3f& direction) const {
        const float beside = std::sin(beside_line) * level_length(line_) * level_length(direction);
        return sign_ * left_of_line(direction) >= beside;
    }

  private:
    [[nodiscard]] static float level_length(const Vec3f& way) { return std::hypot(way.x(), way.y()); }
    [[nodiscard]] float left_of_line(const Vec3f& way) const {
        return line_.x() * way.y() - line_.y() * way.x();
    }

    Vec3f line_;
    float sign_;
};

struct FanDirection {
    Vec3f direction;  // from the anchor
    float cost;       // without the distance's: a lower bound
};

class Fan {
  public:
    // Both may be null.
    Fan(const MapProfile& profile, const PlayerTrack& track, const Vec3f* towards_camera,
        const LineOfAction* line)
        : profile_(profile), towards_camera_(towards_camera) {
        if (line != nullptr) side_.emplace(*line, track.anchor);
        const Vec3f heading =
            towards_camera == nullptr ? track.heading : predicted_heading(track, lag(profile));
        const Look behind = look_along(-heading, 0.0F);
        behind_ = direction_of({behind.yaw, std::clamp(behind.pitch + profile.elevation, -steepest_arm<float>,
                                                       steepest_arm<float>)});
    }

    void add(const Vec3f& direction, float swing) {
        if (angle_between(direction, behind_) > swing) return;
        candidates_[count_++] = {direction, direction_cost(direction)};
    }
    void fill(float swing) {
        const Look behind = look_along(behind_, 0.0F);
        for (const float elevation : elevations) {
            const float pitch =
                std::clamp(behind.pitch + elevation, -steepest_arm<float>, steepest_arm<float>);
            for (int step = -yaw_steps; step < yaw_steps; ++step) {
                const float yaw = static_cast<float>(step) * yaw_step;
                add(direction_of({behind.yaw + yaw, pitch}), swing);
            }
        }
        if (towards_camera_ != nullptr) add(*towards_camera_, swing);
        std::sort(candidates_.begin(), candidates_.begin() + count_,
                  [](const FanDirection& a, const FanDirection& b) { return a.cost < b.cost; });
    }

    [[nodiscard]] FanDirection behind() const { return {behind_, direction_cost(behind_)}; }
    [[nodiscard]] const FanDirection* begin() const { return candidates_.data(); }
    [[nodiscard]] const FanDirection* end() const { return candidates_.data() + count_; }

  private:
    [[nodiscard]] float direction_cost(const Vec3f& direction) const {
        float cost =
            profile_.weight_angle * squared(angle_between(direction, behind_) / profile_.angle_tolerance);
        if (towards_camera_ != nullptr) {
            const float turn = angle_between(direction, *towards_camera_) / profile_.angle_tolerance;
            cost += leave_cost * profile_.weight_inertia_angle * squared(turn);
        }
        if (side_ && !side_->has(direction))
            cost += profile_.weight_angle * squared(right_angle / profile_.angle_tolerance);
        return cost;
    }
    const MapProfile& profile_;
    const Vec3f* towards_camera_;
    std::optional<Side> side_;
    Vec3f behind_;
    std::array<FanDirection, elevations.size() * 2 * yaw_steps + 1> candidates_;
    std::size_t count_ = 0;
};

// A place that spots must be joined to by a free beam, at its time.
struct Origin {
    freespace::Space space;
    Vec3f position;
    freespace::SightOrigin beams;
};

class SpotSearch {
  public:
    SpotSearch(const freespace::Space& space, const MapProfile& profile, const PlayerTrack& track)
        : space_(space),
          profile_(profile),
          distance_weight_(profile.weight_distance),
          beam_radius_(beam_radius(profile, track)),
          now_(origin_at(space, track.anchor)) {}
    // A cut has no motion to pay for: nothing keeps it from a spot further round the player.
    void for_a_cut() { distance_weight_ *= cut_distance_weight; }
    void foresee(const Vec3f& anchor, double time) { later_.emplace(origin_at(space_.at(time), anchor)); }

    // Considers it; whether nothing is in its way at all.
    bool is_free(const FanDirection& candidate) {
        consider(candidate);
        return best_.cost <= candidate.cost;
    }
    void consider(const FanDirection& candidate) {
        float length = free_length(now_, candidate.direction);
        float cost = candidate.cost + distance_cost(length);
        if (cost >= best_.cost) return;
        if (later_) {
            const float later = free_length(*later_, candidate.direction);
            if (later < length) {
                cost = candidate.cost + distance_cost(later);
                length = later;
            }
        }
        if (cost < best_.cost) best_ = {candidate.direction * length, cost};
    }

    [[nodiscard]] const Spot& best() const { return best_; }

  private:
    [[nodiscard]] Origin origin_at(const freespace::Space& space, const Vec3f& anchor) const {
        return {space, anchor, freespace::SightOrigin(space.map(), anchor, beam_radius_)};
    }
    [[nodiscard]] float free_length(const Origin& from, const Vec3f& direction) const {
        const Vec3f end = from.position + profile_.distance * direction;
        const freespace::Sight beam =
            from.space.shortened(from.beams.to(end), from.position, end, beam_radius_);
        return beam.clear ? profile_.distance
                          : std::max(0.0F, beam.free_length - inside_beam * profile_.unit);
    }
    [[nodiscard]] float distance_cost(float length) const {
        return distance_weight_ * squared((profile_.distance - length) / profile_.distance_tolerance);
    }

    const freespace::Space space_;
    const MapProfile& profile_;
    float distance_weight_;
    float beam_radius_;
    Origin now_;
    std::optional<Origin> later_;
    Spot best_{Vec3f::Zero(), std::numeric_limits<float>::infinity()};
};

void consider_all(const Fan& fan, SpotSearch& search) {
    for (const FanDirection& candidate : fan) {
        if (candidate.cost >= search.best().cost) break;
        search.consider(candidate);
    }
}

}  // namespace

Spot spot_to_move_to(const freespace::Space& space, const MapProfile& profile, const PlayerTrack& track,
                     const Vec3f& camera, float dt, SpotMemory& memory) {
    const Vec3f offset = camera - track.anchor;
    const Vec3f towards_camera = offset.normalized();
    Fan fan(profile, track, offset.norm() > profile.unit ? &towards_camera : nullptr, nullptr);
    SpotSearch search(space, profile, track);
    search.foresee(predicted_anchor(space, profile, track), space.time() + profile.prediction);
    memory.age += dt;
    if (!search.is_free(fan.behind())) {
        if (memory.age >= fan_interval) {
            fan.fill(profile.swing);
            memory.age = 0.0F;
        } else {
            fan.add(memory.direction, profile.swing);
        }
        consider_all(fan, search);
    }
    const Vec3f chosen = search.best().offset;
    if (chosen.norm() > profile.unit) memory.direction = chosen.normalized();
    return search.best();
}

Spot spot_to_cut_to(const freespace::Space& space, const MapProfile& profile, const PlayerTrack& track,
                    const LineOfAction* line) {
    Fan fan(profile, track, nullptr, line);
    SpotSearch search(space, profile, track);
    search.for_a_cut();
    fan.fill(std::numbers::pi_v<float>);
    consider_all(fan, search);
    return search.best();
}

}  // namespace camdir::camera
