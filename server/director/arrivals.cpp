#include "director/arrivals.hpp"

#include <algorithm>
#include <utility>

#include "director/clock.hpp"
#include "director/continuity.hpp"

namespace camdir::director {
namespace {

constexpr std::int64_t second_ns = 1'000'000'000;
constexpr std::int64_t even_jitter_ns = 4'000'000;   // of frames that nothing holds up
constexpr std::int64_t max_jitter_ns = 100'000'000;  // more is a stall, or a step of the sender's clock
constexpr std::int64_t max_stall_ns = 10 * second_ns;
// The clocks of sender and director drift apart by less than a millisecond meanwhile.
constexpr std::int64_t stretch_ns = 5 * second_ns;

// Clocks are arbitrary: modulo 2^64.
std::int64_t difference(std::int64_t a, std::int64_t b) {
    return static_cast<std::int64_t>(static_cast<std::uint64_t>(a) - static_cast<std::uint64_t>(b));
}

}  // namespace

Arrivals::Arrivals(std::int64_t max_per_second) : interval_(second_ns / max_per_second) {}

std::optional<Receipt> Arrivals::judge(PoseFrame& frame, std::int64_t now) {
    const std::lock_guard lock(mutex_);
    const Receipt receipt = receive(frame, now);
    last_ = Sent{frame.epoch, frame.source_time, frame.frame_time, now};
    carry_discontinuities(left_out_, frame);
    if (has_room(receipt.punctual)) {
        left_out_.poses.clear();
        return receipt;
    }
    std::swap(left_out_, frame);
    left_out_.movers.reset();
    return std::nullopt;
}

Receipt Arrivals::receive(const PoseFrame& frame, std::int64_t now) {
    if (frame.source_time == 0) return {now, now, false};
    const std::int64_t on_its_way = difference(now, frame.source_time);
    const bool continues = goes_on(frame);
    if (!continues || now >= stretch_ends_) clock_offset_ = difference(frame.source_time, frame.frame_time);
    age(now);
    const std::int64_t fastest = std::min(fastest_, fastest_before_);
    const std::int64_t longer = fastest == never ? 0 : difference(on_its_way, fastest);
    const bool is_credible = longer <= (continues ? max_stall_ns : max_jitter_ns);
    if (!is_credible || longer < -max_jitter_ns) fastest_ = fastest_before_ = never;
    fastest_ = std::min(fastest_, on_its_way);
    return {now, now - (is_credible ? std::max<std::int64_t>(longer, 0) : 0),
            is_credible && longer >= -even_jitter_ns && came_together(frame, now)};
}

// Whether the game has gone on, and the sender's clock with it since the stretch began.
bool Arrivals::goes_on(const PoseFrame& frame) const {
    if (!clock_offset_ || !last_ || frame.epoch != last_->epoch) return false;
    const std::int64_t apart = difference(difference(frame.source_time, frame.frame_time), *clock_offset_);
    return difference(frame.frame_time, last_->frame_time) > 0 && apart <= max_jitter_ns &&
           apart >= -max_jitter_ns;
}

// Less than half of the time between their sending was left when they arrived.
bool Arrivals::came_together(const PoseFrame& frame, std::int64_t now) const {
    if (!last_ || last_->source_time == 0 || frame.epoch != last_->epoch) return false;
    const double sent_s = seconds_between(last_->source_time, frame.source_time);
    return sent_s < max_stall_ns * 1e-9 && 2.0 * seconds_between(last_->received, now) < sent_s;
}

void Arrivals::age(std::int64_t now) {
    if (now < stretch_ends_) return;
    fastest_before_ = last_ && now - last_->received <= max_stall_ns ? fastest_ : never;
    fastest_ = never;
    stretch_ends_ = now + stretch_ns;
}

// A bucket of the tokens of a second. By the time at which a frame would have been punctual, so that a stall
// costs nothing; it is never later than now, whatever the sender's clock says.
bool Arrivals::has_room(std::int64_t punctual) {
    if (full_at_ - punctual > second_ns) return false;
    full_at_ = std::max(full_at_, punctual) + interval_;
    return true;
}

}  // namespace camdir::director
