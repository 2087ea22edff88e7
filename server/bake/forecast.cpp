#include "bake/forecast.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

#include "bake/parameters.hpp"
#include "bake/sample_estimate.hpp"

namespace camdir::bake {
namespace {

// Typical of the default bakes in tests/bench/all-maps.md, on 2 cores; single maps take up to twice as much.
constexpr double serial_seconds = 16e-6;    // a sample
constexpr double parallel_seconds = 44e-6;  // a sample, shared out over the threads
constexpr double fixed_bytes = 24e6;
constexpr double bytes_of_sample = 1'150.0;

double seconds_of_sample(unsigned threads) {
    return serial_seconds + parallel_seconds / std::max(1U, threads);
}

std::uint64_t memory_of(double samples) {
    return static_cast<std::uint64_t>(fixed_bytes + bytes_of_sample * samples);
}

// Nominal units: the first of a series of larger sampling distances that leaves at most so many samples; 0
// when none up to max_d0 does.
double coarser_d0(const SampleEstimate& estimate, double d0, double unit, double max_samples) {
    constexpr double step = 1.19;  // a quarter of an octave
    double coarser = std::ceil(step * d0 / unit);
    while (coarser <= max_d0 && estimate.samples(coarser * unit) > max_samples)
        coarser = std::ceil(step * coarser);
    return coarser <= max_d0 ? coarser : 0.0;
}

std::string size_text(std::uint64_t bytes) {
    std::ostringstream text;
    if (bytes < 1'000'000'000U)
        text << bytes / 1'000'000U << " MB";
    else
        text << std::fixed << std::setprecision(1) << static_cast<double>(bytes) / 1e9 << " GB";
    return text.str();
}

}  // namespace

Forecast forecast(const SampleEstimate& estimate, double d0, double unit, unsigned threads) {
    const double samples = estimate.samples(d0);
    Forecast forecast{samples, samples * seconds_of_sample(threads), memory_of(samples)};
    if (forecast.seconds <= quick_seconds) return forecast;
    forecast.quick_d0 = coarser_d0(estimate, d0, unit, quick_seconds / seconds_of_sample(threads));
    if (forecast.quick_d0 > 0.0)
        forecast.quick_memory = memory_of(estimate.samples(forecast.quick_d0 * unit));
    return forecast;
}

Result<void> check_memory(const Forecast& forecast, const SampleEstimate& estimate, double d0, double unit,
                          std::uint64_t memory, const std::string& source) {
    if (forecast.memory <= memory) return {};
    const double max_samples = (static_cast<double>(memory) - fixed_bytes) / bytes_of_sample;
    const double fitting = coarser_d0(estimate, d0, unit, max_samples);
    std::ostringstream text;
    text << source << ": a bake with d0 = " << d0 / unit << " is expected to take "
         << size_text(forecast.memory) << " of memory for " << std::llround(forecast.samples)
         << " samples, and the limit is " << size_text(memory) << "; ";
    if (fitting > 0.0)
        text << "d0 = " << fitting << " would take " << size_text(memory_of(estimate.samples(fitting * unit)))
             << ", or";
    else
        text << "no d0 up to " << max_d0 << " would fit:";
    text << " allow the bake more memory (bake --memory)";
    return fail(text.str());
}

}  // namespace camdir::bake
