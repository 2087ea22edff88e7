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
constexpr std::int64_t depth_ns = 4 * second_ns;  // of the buckets of what is let in
// The clocks of sender and director drift apart by less than a millisecond meanwhile.
constexpr std::int64_t stretch_ns = 5 * second_ns;

// Clocks are arbitrary: modulo 2^64.
std::int64_t difference(std::int64_t a, std::int64_t b) {
    return static_cast<std::int64_t>(static_cast<std::uint64_t>(a) - static_cast<std::uint64_t>(b));
}

}  // namespace

// A little more: a game server at the very limit may have a clock that is a little fast.
Arrivals::Arrivals(std::int64_t max_per_second) : interval_(second_ns * 98 / 100 / max_per_second) {}

std::optional<Receipt> Arrivals::judge(PoseFrame& frame, std::int64_t now) {
    const std::lock_guard lock(mutex_);
    const Receipt receipt{now, punctual_receipt(frame, now), is_in_burst(frame, now)};
    last_ = Sent{frame.epoch, frame.source_time, frame.frame_time, now};
    carry_discontinuities(left_out_, frame);
    if (has_room(receipt)) {
        left_out_.poses.clear();
        return receipt;
    }
    std::swap(left_out_, frame);
    left_out_.movers.reset();
    return std::nullopt;
}

std::int64_t Arrivals::punctual_receipt(const PoseFrame& frame, std::int64_t now) {
    if (frame.source_time == 0) return now;
    const std::int64_t on_its_way = difference(now, frame.source_time);
    const bool continues = goes_on(frame);
    if (!continues || now >= stretch_ends_) clock_offset_ = difference(frame.source_time, frame.frame_time);
    age(now);
    const std::int64_t fastest = std::min(fastest_, fastest_before_);
    const std::int64_t longer = fastest == never ? 0 : difference(on_its_way, fastest);
    const std::int64_t most = continues ? max_stall_ns : max_jitter_ns;
    if (longer > most || longer < -max_jitter_ns) fastest_ = fastest_before_ = never;
    fastest_ = std::min(fastest_, on_its_way);
    return now - (longer <= most ? std::max<std::int64_t>(longer, 0) : 0);
}

// Whether the game has gone on, and the sender's clock with it since the stretch began.
bool Arrivals::goes_on(const PoseFrame& frame) const {
    if (!clock_offset_ || !last_ || frame.epoch != last_->epoch) return false;
    const std::int64_t apart = difference(difference(frame.source_time, frame.frame_time), *clock_offset_);
    return difference(frame.frame_time, last_->frame_time) > 0 && apart <= max_jitter_ns &&
           apart >= -max_jitter_ns;
}

void Arrivals::age(std::int64_t now) {
    if (now < stretch_ends_) return;
    fastest_before_ = last_ && now - last_->received <= max_stall_ns ? fastest_ : never;
    fastest_ = never;
    stretch_ends_ = now + stretch_ns;
}

bool Arrivals::is_in_burst(const PoseFrame& frame, std::int64_t now) {
    const bool goes_on_sending = frame.source_time != 0 && last_ && last_->source_time != 0 &&
                                 last_->epoch == frame.epoch && last_->source_time <= frame.source_time;
    if (!goes_on_sending) fastest_of_all_ = never;
    if (frame.source_time == 0) return false;
    const std::int64_t on_its_way = difference(now, frame.source_time);
    const bool is_early =
        fastest_of_all_ == never || difference(on_its_way, fastest_of_all_) < -even_jitter_ns;
    fastest_of_all_ = std::min(fastest_of_all_, on_its_way);
    if (!goes_on_sending || is_early) return false;
    // Less than half of the time between their sending was left when they arrived.
    const double sent_s = seconds_between(last_->source_time, frame.source_time);
    return sent_s < max_stall_ns * 1e-9 && 2.0 * seconds_between(last_->received, now) < sent_s;
}

// By the punctual times too, so that a stall costs nothing. They are never later than the others: no clock
// of a sender lets more in. One that runs too slowly leaves what the others allow.
bool Arrivals::has_room(const Receipt& receipt) {
    const auto allows = [&](std::int64_t full_at, std::int64_t time) {
        return full_at - time <= depth_ns - interval_;
    };
    if (!allows(full_at_, receipt.received) && !allows(full_at_by_sender_, receipt.punctual)) return false;
    full_at_ = std::max(full_at_, receipt.received) + interval_;
    full_at_by_sender_ = std::max(full_at_by_sender_, receipt.punctual) + interval_;
    return true;
}

}  // namespace camdir::director
