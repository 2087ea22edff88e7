#include "bench/paper/stopwatch.hpp"

#include <sys/resource.h>

namespace camdir::paper {
namespace {

rusage usage() {
    rusage result{};
    ::getrusage(RUSAGE_SELF, &result);
    return result;
}

double seconds(const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

double cpu_seconds() {
    const rusage now = usage();
    return seconds(now.ru_utime) + seconds(now.ru_stime);
}

}  // namespace

Stopwatch::Stopwatch() : time_(std::chrono::steady_clock::now()), cpu_seconds_(cpu_seconds()) {}

Cost Stopwatch::lap() {
    const auto time = std::chrono::steady_clock::now();
    const double cpu = cpu_seconds();
    const std::chrono::duration<double> elapsed = time - time_;
    const Cost cost{elapsed.count(), cpu - cpu_seconds_};
    time_ = time;
    cpu_seconds_ = cpu;
    return cost;
}

std::uint64_t peak_memory_bytes() {
    return static_cast<std::uint64_t>(usage().ru_maxrss) * 1024U;
}

}  // namespace camdir::paper
