#include "app/progress.hpp"

#include <unistd.h>

#include <iostream>

namespace camdir::app {

ProgressLine::ProgressLine() : terminal_(::isatty(STDERR_FILENO) == 1) {}

void ProgressLine::show(std::string_view what, std::uint64_t done, std::uint64_t total) {
    if (!terminal_) return;
    std::string line(what);
    if (total > 0) {
        const double share = static_cast<double>(done) / static_cast<double>(total);
        line += " " + std::to_string(static_cast<int>(100.0 * share)) + " %";
    }
    const std::scoped_lock lock(mutex_);
    if (line == shown_) return;
    std::cerr << "\r\x1b[K" << line << std::flush;
    shown_ = line;
}

void ProgressLine::clear() {
    const std::scoped_lock lock(mutex_);
    if (shown_.empty()) return;
    std::cerr << "\r\x1b[K" << std::flush;
    shown_.clear();
}

}  // namespace camdir::app
