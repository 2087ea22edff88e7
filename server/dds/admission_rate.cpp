#include "dds/admission_rate.hpp"

#include <algorithm>

namespace camdir::dds {

AdmissionRate::AdmissionRate(std::size_t burst, double per_second)
    : interval_(std::chrono::duration_cast<Time::duration>(std::chrono::duration<double>(1.0 / per_second))),
      depth_(interval_ * static_cast<Time::rep>(burst)) {}

bool AdmissionRate::allows(const SenderId& sender, Time now) const {
    const auto known = full_at_.find(sender);
    return known == full_at_.end() || known->second + interval_ - now <= depth_;
}

void AdmissionRate::take(const SenderId& sender, Time now) {
    Time& full_at = full_at_[sender];
    full_at = std::max(full_at, now) + interval_;
}

void AdmissionRate::forget_idle(Time now) {
    std::erase_if(full_at_, [now](const auto& sender) { return sender.second <= now; });
}

}  // namespace camdir::dds
