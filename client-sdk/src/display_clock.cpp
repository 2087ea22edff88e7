#include "display_clock.hpp"

#include <algorithm>
#include <cstdlib>

namespace camdir::sdk {

std::int64_t DisplayClock::target() const {
    const std::size_t count = std::min(observed_, window);
    return *std::max_element(offsets_.begin(), offsets_.begin() + static_cast<std::ptrdiff_t>(count));
}

void DisplayClock::observe(std::int64_t frame_time, std::int64_t now) {
    const std::int64_t offset = frame_time - now;
    if (observed_ > 0 && offset < target() - jump) observed_ = 0;
    offsets_[observed_ % window] = offset;
    ++observed_;
    newest_ = observed_ == 1 && !displayed_ ? frame_time : std::max(newest_, frame_time);
}

void DisplayClock::clear() {
    observed_ = 0;
    displayed_.reset();
}

std::optional<std::int64_t> DisplayClock::at(std::int64_t now) {
    if (observed_ == 0) return std::nullopt;
    const std::int64_t error = target() - offset_;
    const std::int64_t limit = std::max<std::int64_t>(now - last_now_, 0) / slew;
    const bool jumps = !displayed_ || std::abs(error) > jump;
    offset_ += jumps ? error : std::clamp(error, -limit, limit);
    last_now_ = now;
    const std::int64_t wanted = std::min(now + offset_ - delay_, newest_);
    displayed_ = std::max(displayed_.value_or(wanted), wanted);
    return displayed_;
}

}  // namespace camdir::sdk
