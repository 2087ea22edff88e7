#include "maps/schedule.hpp"

#include <algorithm>
#include <cassert>
#include <numeric>
#include <utility>

#include "bake/geometry/triangle.hpp"
#include "bake/shell.hpp"

namespace camdir::maps {
namespace {

double area_of(const scene::Scene& scene) {
    double sum = 0.0;
    for (const auto& [a, b, c] : scene.triangles)
        sum += bake::area({scene.vertices[a], scene.vertices[b], scene.vertices[c]});
    return sum;
}

}  // namespace

std::uint64_t estimate_memory(const scene::Scene& scene, double d0) {
    constexpr double fixed = 48.0 * 1024.0 * 1024.0;
    constexpr double bytes_of_a_sample = 1500.0;
    constexpr double samples_on_square = 1.5;
    constexpr double most = 1e15;  // no sum of estimates overflows
    const double around = scene.brushes.empty() ? bake::most_shell_samples : 0.0;
    const double samples = samples_on_square * area_of(scene) / (d0 * d0) +
                           static_cast<double>(scene.vertices.size() + scene.points.size()) + around;
    return static_cast<std::uint64_t>(std::min(fixed + bytes_of_a_sample * samples, most));
}

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
