#include "director/pace.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace camdir::director {
namespace {

constexpr double late_share = 0.02;  // of the frames, beside those that wait: hiccups of any machine
constexpr double headroom = 1.15;    // of the pace that would just do
constexpr double most_busy = 0.7;    // share of the workers' time, at the pace to come

}  // namespace

void Pace::observe(const Load& load) {
    const auto superseded = static_cast<double>(load.superseded);
    const bool is_late = superseded > late_share * static_cast<double>(load.taken + load.superseded);
    const double missing = static_cast<double>(load.taken + load.superseded) /
                           static_cast<double>(std::max<std::uint64_t>(load.taken, 1));
    missing_ = late_ == 0 ? missing : std::min(missing_, missing);
    late_ = is_late ? late_ + 1 : 0;
    calm_ = is_late ? 0 : calm_ + 1;
    since_speed_up_ = std::min(since_speed_up_ + 1, longest_calm);
    const std::uint32_t frames = frames_per_camera();
    if (late_ >= 3) {
        slow_down();
    } else if (frames > 1 && calm_ >= calm_needed_ && load.busy * frames / (frames - 1) < most_busy) {
        speed_up();
    } else if (frames == 1 && calm_ >= longest_calm) {
        calm_needed_ = shortest_calm;
    }
}

void Pace::slow_down() {
    const double wanted = std::ceil(std::min<double>(headroom * missing_ * frames_per_camera(), slowest));
    if (since_speed_up_ <= calm_needed_) calm_needed_ = std::min(2 * calm_when_slowed_, longest_calm);
    calm_when_slowed_ = calm_needed_;
    frames_.store(static_cast<std::uint32_t>(wanted), std::memory_order_relaxed);
    late_ = 0;
    last_step_was_up_ = false;
}

void Pace::speed_up() {
    if (std::exchange(last_step_was_up_, true)) calm_needed_ = std::max(calm_needed_ / 2, shortest_calm);
    frames_.store(frames_per_camera() - 1, std::memory_order_relaxed);
    calm_ = 0;
    since_speed_up_ = 0;
}

}  // namespace camdir::director
