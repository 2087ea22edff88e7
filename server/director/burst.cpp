#include "director/burst.hpp"

namespace camdir::director {
namespace {

constexpr double jitter_ns = 4e6;  // of punctual frames

}  // namespace

bool Burst::goes_on_with(const PoseFrame& frame, std::int64_t received_ns) {
    if (frame.source_time == 0) {
        last_.reset();
        return false;
    }
    // In double: the difference of two times of any sender.
    const Arrival arrival{frame.epoch, static_cast<double>(frame.source_time),
                          static_cast<double>(received_ns)};
    const auto sent_since = [&](const Arrival& other) { return arrival.sent_ns - other.sent_ns; };
    const auto received_since = [&](const Arrival& other) { return arrival.received_ns - other.received_ns; };
    if (!last_ || last_->epoch != frame.epoch || sent_since(*last_) < 0.0) {
        last_ = punctual_ = arrival;
        return false;
    }
    // Less than half of the interval was left when they arrived.
    const bool together = 2.0 * received_since(*last_) < sent_since(*last_);
    const bool early = sent_since(*punctual_) > received_since(*punctual_) + jitter_ns;
    if (sent_since(*punctual_) >= received_since(*punctual_)) punctual_ = arrival;
    last_ = arrival;
    return together && !early;
}

}  // namespace camdir::director
