#include "bake/forecast.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

#include "bake/parameters.hpp"
#include "bake/sample_estimate.hpp"

namespace camdir::bake {
namespace {

// Fitted to the default bakes of 63 maps (tests/bench/all-maps.md).
constexpr double serial_seconds = 16e-6;    // a sample
constexpr double parallel_seconds = 44e-6;  // a sample, shared out over the threads
constexpr double fixed_bytes = 24e6;
constexpr double bytes_of_sample = 1'150.0;
constexpr double quick_seconds = 60.0;

Forecast cost_of(double samples, unsigned threads) {
    const double seconds = samples * (serial_seconds + parallel_seconds / std::max(1U, threads));
    return {samples, seconds, static_cast<std::uint64_t>(fixed_bytes + bytes_of_sample * samples)};
}

std::string gigabytes(std::uint64_t bytes) {
    std::ostringstream text;
    text << std::fixed << std::setprecision(1) << static_cast<double>(bytes) / 1e9 << " GB";
    return text.str();
}

}  // namespace

Forecast forecast(const SampleEstimate& estimate, double d0, double unit, unsigned threads) {
    Forecast forecast = cost_of(estimate.samples(d0), threads);
    if (forecast.seconds <= quick_seconds) return forecast;
    constexpr double step = 1.19;  // a quarter of an octave
    for (double coarser = std::ceil(step * d0 / unit); coarser <= max_d0;
         coarser = std::ceil(step * coarser)) {
        const Forecast quick = cost_of(estimate.samples(coarser * unit), threads);
        if (quick.seconds > quick_seconds) continue;
        forecast.quick_d0 = coarser;
        forecast.quick_memory = quick.memory;
        break;
    }
    return forecast;
}

Result<void> check_memory(const Forecast& forecast, std::uint64_t memory, double d0,
                          const std::string& source) {
    if (forecast.memory <= memory) return {};
    std::ostringstream text;
    text << source << ": a bake with d0 = " << d0 << " is expected to take " << gigabytes(forecast.memory)
         << " of memory for " << std::llround(forecast.samples) << " samples, and the limit is "
         << gigabytes(memory) << "; ";
    if (forecast.quick_d0 > 0.0)
        text << "d0 = " << forecast.quick_d0 << " would take " << gigabytes(forecast.quick_memory)
             << " and about a minute";
    else
        text << "choose a larger d0";
    text << ", or raise the limit (--memory)";
    return fail(text.str());
}

}  // namespace camdir::bake
