#include "app/progress.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <iostream>

namespace camdir::app {
namespace {

constexpr std::chrono::milliseconds refresh_period{250};
constexpr double plain_period = 10.0;  // seconds

std::size_t terminal_width() {
    winsize size{};
    const bool known = ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 1;
    return known ? size.ws_col : 80;
}

}  // namespace

std::string bar(double fraction) {
    constexpr std::size_t width = 24;
    const double share = std::clamp(fraction, 0.0, 1.0);
    const auto filled = static_cast<std::size_t>(share * width);
    return "[" + std::string(filled, '#') + std::string(width - filled, ' ') + "] " +
           std::to_string(static_cast<int>(100.0 * share)) + " %";
}

std::string times_text(double seconds, std::optional<double> remaining) {
    const std::string elapsed = std::to_string(std::lround(seconds)) + " s";
    if (!remaining) return elapsed;
    if (*remaining < 100.0) return elapsed + ", about " + std::to_string(std::lround(*remaining)) + " s left";
    return elapsed + ", about " + std::to_string(std::lround(*remaining / 60.0)) + " min left";
}

ProgressLine::ProgressLine() : terminal_(::isatty(STDERR_FILENO) == 1) {}

ProgressLine::~ProgressLine() {
    refresher_.request_stop();
    if (refresher_.joinable()) refresher_.join();
    clear();
}

void ProgressLine::show(Text text) {
    const std::scoped_lock lock(mutex_);
    text_ = std::move(text);
    if (terminal_) draw();
    if (!refresher_.joinable())
        refresher_ = std::jthread([this](const std::stop_token& stop) { refresh(stop); });
}

void ProgressLine::show(std::string_view activity, std::uint64_t done, std::uint64_t total) {
    std::string text(activity);
    if (total > 0) {
        text.resize(std::max<std::size_t>(text.size(), 12), ' ');
        text += bar(static_cast<double>(done) / static_cast<double>(total));
    } else if (done > 0) {
        text += " " + std::to_string(done);
    }
    show([text](double seconds) { return text + "  " + times_text(seconds); });
}

void ProgressLine::clear() {
    const std::scoped_lock lock(mutex_);
    text_ = nullptr;
    if (drawn_.empty()) return;
    std::cerr << "\r\x1b[K" << std::flush;
    drawn_.clear();
}

double ProgressLine::seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

void ProgressLine::refresh(const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    while (!stop.stop_requested()) {
        changed_.wait_for(lock, stop, refresh_period, [] { return false; });
        if (!stop.stop_requested() && text_) draw();
    }
}

void ProgressLine::draw() {
    const double now = seconds();
    if (!terminal_) {
        if (now - printed_ < plain_period) return;
        std::cerr << text_(now) + "\n" << std::flush;
        printed_ = now;
        return;
    }
    const std::string line = text_(now).substr(0, terminal_width() - 1);
    if (line == drawn_) return;
    std::cerr << "\r\x1b[K" << line << std::flush;
    drawn_ = line;
}

}  // namespace camdir::app
