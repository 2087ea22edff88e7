// How fast each participant may begin matches.
#pragma once

#include <chrono>
#include <cstddef>
#include <map>

#include "dds/sender.hpp"

namespace camdir::dds {

// A token bucket for each participant: `burst` matches at once, then `per_second`. Cyclone DDS keeps
// something of every endpoint that it has ever announced: no participant alone shall make that many. One
// thread at a time; times are the caller's.
class AdmissionRate {
  public:
    using Time = std::chrono::steady_clock::time_point;

    // Both > 0.
    AdmissionRate(std::size_t burst, double per_second);

    [[nodiscard]] bool allows(const SenderId& sender, Time now) const;
    // One has begun a match.
    void take(const SenderId& sender, Time now);
    // Forgets those whose buckets are full again.
    void forget_idle(Time now);

  private:
    const Time::duration interval_;  // in which a token comes
    const Time::duration depth_;     // in which an empty bucket fills
    std::map<SenderId, Time> full_at_;
};

}  // namespace camdir::dds
