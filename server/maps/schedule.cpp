#include "maps/schedule.hpp"

#include <algorithm>
#include <cassert>
#include <numeric>
#include <utility>

namespace camdir::maps {

BakeSchedule::BakeSchedule(std::vector<std::uint64_t> needs, std::uint64_t budget, std::size_t slots)
    : needs_(std::move(needs)), budget_(budget), slots_(slots), waiting_(needs_.size()) {
    assert(slots_ > 0);
    std::iota(waiting_.begin(), waiting_.end(), std::size_t{0});
    std::stable_sort(waiting_.begin(), waiting_.end(),
                     [&](std::size_t a, std::size_t b) { return needs_[a] > needs_[b]; });
}

std::optional<std::size_t> BakeSchedule::start() {
    if (running_ >= slots_) return std::nullopt;
    const auto fits = [&](std::size_t job) {
        return running_ == 0 || (used_ <= budget_ && needs_[job] <= budget_ - used_);
    };
    const auto found = std::find_if(waiting_.begin(), waiting_.end(), fits);
    if (found == waiting_.end()) return std::nullopt;
    const std::size_t job = *found;
    waiting_.erase(found);
    ++running_;
    used_ += needs_[job];
    return job;
}

void BakeSchedule::finish(std::size_t job) {
    assert(running_ > 0);
    --running_;
    used_ -= needs_[job];
}

}  // namespace camdir::maps
