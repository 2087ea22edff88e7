#include "service/supervisor.hpp"

#include <systemd/sd-daemon.h>

#include <ctime>

namespace camdir::service {
namespace {

// Failures are ignored: a supervisor that cannot be reached does not wait for notifications.
void notify(const std::string& state) {
    (void)::sd_notify(0, state.c_str());
}

std::string one_line(std::string text) {
    for (char& c : text)
        if (c == '\n') c = ' ';
    return text;
}

}  // namespace

void notify_ready(const std::string& status) {
    notify("READY=1\nSTATUS=" + one_line(status));
}

void notify_reloading() {
    timespec now{};
    ::clock_gettime(CLOCK_MONOTONIC, &now);
    const auto microseconds = static_cast<long long>(now.tv_sec) * 1'000'000 + now.tv_nsec / 1'000;
    notify("RELOADING=1\nMONOTONIC_USEC=" + std::to_string(microseconds));
}

void notify_stopping() {
    notify("STOPPING=1\nSTATUS=draining");
}

void notify_starting(const std::string& status, std::chrono::seconds more) {
    notify("EXTEND_TIMEOUT_USEC=" + std::to_string(std::chrono::microseconds(more).count()) +
           "\nSTATUS=" + one_line(status));
}

void notify_alive() {
    notify("WATCHDOG=1");
}

}  // namespace camdir::service
