#include "camera/future.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace camdir::camera {
namespace {

constexpr double velocity_span = 0.048;  // s over which the velocity is taken
constexpr double turn_span = 0.016;      // s over which the turning is taken
// s that are predicted after the recorded poses: more for cameras that move more smoothly, whose path would
// not know its goals.
constexpr double least_prediction = 0.4;
constexpr double most_prediction = 2.5;
constexpr double prediction_share = 3.6;   // of the profile's time constant of motion
constexpr float run_persistence = 0.5F;    // s: how long players keep running
constexpr float fall_persistence = 0.15F;  // s: how long they keep rising or falling
constexpr float from_wall = 16.0F;         // units at which a wall stops them
// How long players keep turning, s: a turn that has just begun, one at constant speed, one that slows down.
constexpr float turn_begin = 0.13F;
constexpr float turn_constant = 0.1F;
constexpr float turn_end = 0.02F;
constexpr float largest_turn = 2.0F;  // rad
constexpr float straight_up = 0.5F * std::numbers::pi_v<float>;

Look view_of(const Pose& pose, float near_yaw) {
    Look view = look_along(pose.orientation.normalized() * Vec3f::UnitX(), near_yaw);
    view.yaw = near_yaw + wrapped(view.yaw - near_yaw);
    return view;
}

// The continuous stretch of the window around an index, from as early on as velocities are taken from.
struct Stretch {
    Window window;
    std::size_t first;
    std::size_t last;

    Stretch(Window all, std::size_t index) : window(all), first(index), last(index) {
        while (continuous(window, static_cast<std::ptrdiff_t>(last)))
            ++last;
        const double interval = last > 0 ? window[last].time - window[last - 1].time : 0.0;
        const double since =
            window[index].time - std::max(velocity_span, 2.0 * std::max(turn_span, interval));
        while (first > 0 && window[first].time > since &&
               continuous(window, static_cast<std::ptrdiff_t>(first) - 1))
            --first;
    }
    [[nodiscard]] double begin() const { return window[first].time; }
    [[nodiscard]] double end() const { return window[last].time; }
};

// Reads a stretch at ascending times.
class Reader {
  public:
    Reader(const Stretch& stretch, float yaw) : stretch_(stretch), index_(stretch.first), yaw_(yaw) {}

    // Between the stretch's begin and end; clamped to them outside.
    Future::Sample at(double time) {
        while (index_ < stretch_.last && stretch_.window[index_ + 1].time <= time)
            ++index_;
        const TimedPose& a = stretch_.window[index_];
        const Look view = view_of(a.pose, yaw_);
        yaw_ = view.yaw;
        if (index_ == stretch_.last || time <= a.time) return {a.pose.eye, view};
        const TimedPose& b = stretch_.window[index_ + 1];
        const Look next = view_of(b.pose, yaw_);
        const auto share = static_cast<float>((time - a.time) / (b.time - a.time));
        return {a.pose.eye + share * (b.pose.eye - a.pose.eye),
                {view.yaw + share * (next.yaw - view.yaw), view.pitch + share * (next.pitch - view.pitch)}};
    }

  private:
    const Stretch& stretch_;
    std::size_t index_;
    float yaw_;
};

struct Rates {
    Vec3f velocity;
    float yaw;
    float pitch;
    float persistence;  // s: of the turning
};

// A turn that slows down is nearly over; one that gains speed has just begun.
float persistence(float rate, float rate_before) {
    const float ratio = std::abs(rate) / std::max(std::abs(rate_before), 1e-3F);
    if (rate * rate_before < 0.0F) return turn_end;
    if (ratio < 1.0F) {
        const float share = std::clamp((ratio - 0.7F) / 0.25F, 0.0F, 1.0F);
        return turn_end + share * (turn_constant - turn_end);
    }
    const float share = std::clamp((ratio - 1.05F) / 0.3F, 0.0F, 1.0F);
    return turn_constant + share * (turn_begin - turn_constant);
}

// `unit`: in map units.
Rates rates_at(const Stretch& stretch, double time, float yaw, float unit) {
    Rates rates{plausible(stretch.window[stretch.last].pose.velocity, unit), 0.0F, 0.0F, turn_constant};
    if (stretch.first == stretch.last) return rates;
    const auto span_from = [&](double wanted) {
        return std::max(stretch.begin(), std::min(time - wanted, stretch.window[stretch.last - 1].time));
    };
    const double moved_since = span_from(velocity_span);
    const auto sample = [&](double at) { return Reader(stretch, yaw).at(at); };
    const Future::Sample now = sample(time);
    rates.velocity =
        plausible((now.eye - sample(moved_since).eye) / static_cast<float>(time - moved_since), unit);
    const double once = std::max(turn_span, time - stretch.window[stretch.last - 1].time);
    if (time - once < stretch.begin() - 1e-9) return rates;
    const Look before = sample(time - once).view;
    const auto seconds = static_cast<float>(once);
    rates.yaw = wrapped(now.view.yaw - before.yaw) / seconds;
    rates.pitch = (now.view.pitch - before.pitch) / seconds;
    const Look earlier = sample(std::max(stretch.begin(), time - 2.0 * once)).view;
    rates.persistence = persistence(rates.yaw, wrapped(before.yaw - earlier.yaw) / seconds);
    return rates;
}

// The time that a motion which fades with `persistence` makes up for, after `seconds`.
float faded(float seconds, float persistence) {
    return persistence * (1.0F - std::exp(-seconds / persistence));
}

Vec3f travel(const Rates& rates, float seconds) {
    const float run = faded(seconds, run_persistence);
    const float fall = faded(seconds, fall_persistence);
    return rates.velocity.cwiseProduct(Vec3f(run, run, fall));
}

}  // namespace

void foresee(const freespace::Space& space, const MapProfile& profile, Window window, double start,
             double step, double horizon, float yaw, freespace::RecentBalls& balls, Future& future) {
    const Stretch stretch(window, static_cast<std::size_t>(index_at(window, start)));
    const double known = std::clamp(stretch.end() - start, 0.0, horizon);
    const double predicted =
        std::clamp(prediction_share * profile.motion_smoothing, least_prediction, most_prediction);
    const double whole = known + predicted;
    future.start = start;
    future.step = step;
    future.count = std::min(Future::capacity, static_cast<std::size_t>(whole / step + 1e-6) + 1);
    future.known = std::min(future.count, static_cast<std::size_t>(known / step + 1e-6) + 1);
    if (stretch.end() < start - 1e-6) future.known = 0;

    Reader reader(stretch, yaw);
    for (std::size_t i = 0; i < future.known; ++i)
        future.samples[i] = reader.at(start + static_cast<double>(i) * step);
    if (future.known == future.count) return;

    const double last_time = std::min(stretch.end(), start + horizon);
    const Future::Sample last = reader.at(last_time);
    const Rates rates = rates_at(stretch, last_time, last.view.yaw, profile.unit);
    const auto longest = static_cast<float>(start + static_cast<double>(future.count - 1) * step - last_time);
    const Vec3f way = travel(rates, longest);
    float share = 1.0F;  // of the way that walls leave
    const float length = way.norm();
    if (length > profile.unit) {
        const freespace::Sight free =
            freespace::sight(space.at(last_time), last.eye, last.eye + way, 0.0F, balls);
        if (!free.clear) share = std::max(0.0F, free.free_length - from_wall * profile.unit) / length;
    }
    for (std::size_t i = future.known; i < future.count; ++i) {
        const auto seconds =
            static_cast<float>(std::max(0.0, start + static_cast<double>(i) * step - last_time));
        Vec3f moved = travel(rates, seconds);
        if (moved.norm() > share * length) moved *= share * length / std::max(moved.norm(), 1e-6F);
        const float turn = faded(seconds, rates.persistence);
        const float turned = std::clamp(rates.yaw * turn, -largest_turn, largest_turn);
        const float pitch = std::clamp(last.view.pitch + rates.pitch * turn, -straight_up, straight_up);
        future.samples[i] = {last.eye + moved, {last.view.yaw + turned, pitch}};
    }
}

}  // namespace camdir::camera
