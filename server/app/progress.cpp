#include "app/progress.hpp"

#include <unistd.h>

#include <algorithm>
#include <iostream>

namespace camdir::app {
namespace {

// `[#####     ] 52 %  1234 of 2345`
std::string bar(std::uint64_t done, std::uint64_t total) {
    constexpr std::size_t width = 24;
    const double share = std::min(1.0, static_cast<double>(done) / static_cast<double>(total));
    const auto filled = static_cast<std::size_t>(share * width);
    return "[" + std::string(filled, '#') + std::string(width - filled, ' ') + "] " +
           std::to_string(static_cast<int>(100.0 * share)) + " %  " + std::to_string(done) + " of " +
           std::to_string(total);
}

}  // namespace

ProgressLine::ProgressLine() : terminal_(::isatty(STDERR_FILENO) == 1) {}

void ProgressLine::show(std::string_view what, std::uint64_t done, std::uint64_t total) {
    if (!terminal_) return;
    const auto elapsed =
        std::chrono::duration_cast<std::chrono::seconds>(std::chrono::steady_clock::now() - start_);
    std::string line(what);
    line.resize(std::max<std::size_t>(line.size(), 12), ' ');
    if (total > 0) line += bar(done, total) + "  ";
    line += std::to_string(elapsed.count()) + " s";
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
