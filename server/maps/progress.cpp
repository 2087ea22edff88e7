#include "maps/progress.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace camdir::maps {
namespace {

constexpr double least_fraction = 0.02;  // below, a speed says nothing
constexpr double least_seconds = 1.0;

// Mean shares of the stages in the seconds of default bakes with 2 threads (`bake --report`) of oa_dm1,
// oa_dm3, oa_rpg3dm2, aggressor, bunker-defense, dung3on, fegefeuer and lqdm1.
constexpr std::array<StageWeight, 16> surface_weights{{
    {"medial axis", 0.051, true},
    {"forecast", 0.006, false},
    {"sample", 0.043, true},
    {"weld", 0.013, true},
    {"delaunay", 0.161, false},
    {"voronoi", 0.024, false},
    {"triangulate", 0.009, true},
    {"clearance", 0.028, true},
    {"crossing", 0.002, true},
    {"inside", 0.029, false},
    {"certify", 0.122, true},
    {"reduce", 0.449, false},
    {"pack", 0.001, false},
    {"recertify", 0.011, true},
    {"movers", 0.001, false},
    {"fixed shots", 0.050, false},
}};

// The same of the point clouds room_scan1 and scan_430.
constexpr std::array<StageWeight, 12> cloud_weights{{
    {"thin", 0.002, true},
    {"forecast", 0.001, false},
    {"delaunay", 0.026, false},
    {"voronoi", 0.003, false},
    {"triangulate", 0.002, true},
    {"clearance", 0.027, true},
    {"certify", 0.207, true},
    {"inside", 0.001, false},
    {"reduce", 0.652, false},
    {"pack", 0.001, false},
    {"recertify", 0.028, true},
    {"fixed shots", 0.050, false},
}};

// The part of a stage that is done after `share` of its expected time: the same up to 3/4, then ever more
// slowly towards 1, without a jump of the speed.
double part_after(double share) {
    return share < 0.75 ? share : 1.0 - 0.0625 / (share - 0.5);
}

}  // namespace

std::span<const StageWeight> surface_stages() {
    return surface_weights;
}

std::span<const StageWeight> cloud_stages() {
    return cloud_weights;
}

void BakeProgress::update(const bake::Progress& progress, double seconds) {
    reached_ = fraction(seconds);
    if (progress.stage != stage_) enter(progress.stage, seconds);
    if (progress.total == 0) return;
    const double share = static_cast<double>(progress.done) / static_cast<double>(progress.total);
    reported_ = std::clamp(share, reported_, 1.0);
}

void BakeProgress::enter(std::string_view stage, double seconds) {
    stage_ = stage;
    stage_start_ = seconds;
    weight_ = reported_ = expected_ = 0.0;
    for (const auto& list : {surface_stages(), cloud_stages()}) {
        if (!stages_.empty() || list.front().stage != stage) continue;
        stages_ = list;
        bake_start_ = seconds;
    }
    double before = 0.0;
    for (const StageWeight& entry : stages_) {
        if (entry.stage != stage) {
            before += entry.weight;
            continue;
        }
        before_ = before;
        weight_ = entry.weight;
        one_pass_ = entry.one_pass;
        if (before_ >= least_fraction) expected_ = (seconds - bake_start_) / before_ * weight_;
        return;
    }
}

double BakeProgress::fraction(double seconds) const {
    double part = one_pass_ ? reported_ : 0.0;
    if (!one_pass_ && expected_ > 0.0) part = part_after((seconds - stage_start_) / expected_);
    return std::clamp(before_ + weight_ * part, reached_, 1.0);
}

void TimeEstimate::update(double fraction, double seconds) {
    if (fraction < least_fraction || seconds < least_seconds) return;
    total_ = total(fraction, seconds);
    updated_ = seconds;
}

std::optional<double> TimeEstimate::remaining(double fraction, double seconds) const {
    if (total_ == 0.0) return std::nullopt;
    return std::max(0.0, total(fraction, seconds) - seconds);
}

// Approaches seconds / fraction, the faster the less time that leaves.
double TimeEstimate::total(double fraction, double seconds) const {
    const double now = seconds / fraction;
    if (total_ == 0.0) return now;
    const double constant = 2.0 + 0.1 * std::min(seconds, now - seconds);
    return now + (total_ - now) * std::exp((updated_ - seconds) / constant);
}

}  // namespace camdir::maps
