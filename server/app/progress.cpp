#include "app/progress.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <iostream>

namespace camdir::app {
namespace {

std::size_t terminal_width() {
    winsize size{};
    const bool known = ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 1;
    return known ? size.ws_col : 80;
}

}  // namespace

std::string bar(std::uint64_t done, std::uint64_t total) {
    constexpr std::size_t width = 24;
    const double share = std::min(1.0, static_cast<double>(done) / static_cast<double>(total));
    const auto filled = static_cast<std::size_t>(share * width);
    return "[" + std::string(filled, '#') + std::string(width - filled, ' ') + "] " +
           std::to_string(static_cast<int>(100.0 * share)) + " %";
}

ProgressLine::ProgressLine() : terminal_(::isatty(STDERR_FILENO) == 1) {}

void ProgressLine::show(std::string_view what, std::uint64_t done, std::uint64_t total) {
    if (!terminal_) return;
    std::string text(what);
    text.resize(std::max<std::size_t>(text.size(), 12), ' ');
    if (total > 0) text += bar(done, total) + "  " + std::to_string(done) + " of " + std::to_string(total);
    show(text);
}

void ProgressLine::show(std::string_view text) {
    if (!terminal_) return;
    const auto elapsed =
        std::chrono::duration_cast<std::chrono::seconds>(std::chrono::steady_clock::now() - start_);
    const std::string seconds = "  " + std::to_string(elapsed.count()) + " s";
    const std::size_t width = terminal_width() - 1;
    const std::string line =
        std::string(text.substr(0, width > seconds.size() ? width - seconds.size() : 0)) + seconds;
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
