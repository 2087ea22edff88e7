#include "usage.hpp"

#include <sched.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>
#include <utility>

namespace camdir::soak {
namespace {

// The number of entries; 0 when the folder is gone.
std::uint32_t entries_of(const std::filesystem::path& folder) {
    std::error_code gone;
    std::uint32_t count = 0;
    for (std::filesystem::directory_iterator entry(folder, gone), end; !gone && entry != end;
         entry.increment(gone))
        ++count;
    return count;
}

}  // namespace

std::optional<Usage> usage_of(pid_t process) {
    const std::filesystem::path folder = "/proc/" + std::to_string(process);
    Usage usage{.process = process};
    std::ifstream status(folder / "status");
    for (std::string key; status >> key;) {
        double value = 0.0;
        if (key == "VmRSS:" && status >> value) usage.resident_mib = value / 1024.0;
        if (key == "Threads:") status >> usage.threads;
    }
    if (usage.resident_mib == 0.0) return std::nullopt;  // ended, or a zombie
    usage.descriptors = entries_of(folder / "fd");
    return usage;
}

Metronome::Metronome() {
    cpu_set_t allowed;
    if (::sched_getaffinity(0, sizeof allowed, &allowed) != 0)
        throw std::system_error(errno, std::generic_category(), "sched_getaffinity");
    for (int processor = 0; processor < CPU_SETSIZE; ++processor)
        if (CPU_ISSET(processor, &allowed))
            ticking_.emplace_back([this, processor](const std::stop_token& stop) { tick(processor, stop); });
}

double Metronome::take_stall() {
    const std::lock_guard lock(mutex_);
    return std::exchange(stall_, 0.0);
}

void Metronome::tick(int processor, const std::stop_token& stop) {
    cpu_set_t own;
    CPU_ZERO(&own);
    CPU_SET(processor, &own);
    ::sched_setaffinity(0, sizeof own, &own);  // fails where the processor has just been taken away
    using Clock = std::chrono::steady_clock;
    constexpr std::chrono::milliseconds interval(5);
    while (!stop.stop_requested()) {
        const Clock::time_point due = Clock::now() + interval;
        std::this_thread::sleep_until(due);
        const std::chrono::duration<double> late = Clock::now() - due;
        const std::lock_guard lock(mutex_);
        stall_ = std::max(stall_, late.count());
    }
}

}  // namespace camdir::soak
