#include "direction/material.hpp"

#include <algorithm>

namespace camdir::direction {
namespace {

constexpr Beat history = 20;                // beats whose moments may reach into a plan
constexpr double longest_lead_in_s = 10.0;  // of a moment before its event
constexpr std::size_t worth_moving = 64;

double seconds_of(Beat beat) {
    return static_cast<double>(beat) * beat_s;
}

}  // namespace

void Material::add(const Event& event) {
    events_.insert(std::ranges::upper_bound(events_, event.time, {}, &Event::time), event);
    if (events_.size() > max_events) forget_events(max_events / 8);
}

void Material::forget_before(Beat now) {
    footage_.forget_before(now - history - beat_of(memory_s + longest_lead_in_s));
    const double oldest = seconds_of(now - history) - memory_s;
    const auto stale = std::ranges::lower_bound(events_, oldest, {}, &Event::time) - events_.begin();
    if (static_cast<std::size_t>(stale) >= worth_moving) forget_events(static_cast<std::size_t>(stale));
}

void Material::forget_events(std::size_t count) {
    const auto end = events_.begin() + static_cast<std::ptrdiff_t>(count);
    std::for_each(events_.begin(), end, [&](const Event& event) { tally_.count(event); });
    events_.erase(events_.begin(), end);
}

std::vector<Moment> Material::moments(const Rules& rules, double unit, Beat now) const {
    const auto known = std::ranges::lower_bound(events_, seconds_of(footage_.beats()), {}, &Event::time);
    return find_moments(footage_, {events_.begin(), known}, rules, unit,
                        std::max(footage_.first(), now - history), tally_);
}

}  // namespace camdir::direction
