#include "service/supervisor.hpp"

#include <systemd/sd-daemon.h>

#include <ctime>

namespace camdir::service {
namespace {

// A supervisor that cannot be told is one that does not wait for it.
void tell(const std::string& state) {
    (void)::sd_notify(0, state.c_str());
}

std::string one_line(std::string text) {
    for (char& c : text)
        if (c == '\n') c = ' ';
    return text;
}

}  // namespace

void tell_ready(const std::string& status) {
    tell("READY=1\nSTATUS=" + one_line(status));
}

void tell_reloading() {
    timespec now{};
    ::clock_gettime(CLOCK_MONOTONIC, &now);
    const auto microseconds = static_cast<long long>(now.tv_sec) * 1'000'000 + now.tv_nsec / 1'000;
    tell("RELOADING=1\nMONOTONIC_USEC=" + std::to_string(microseconds));
}

void tell_stopping() {
    tell("STOPPING=1\nSTATUS=draining");
}

void tell_starting(const std::string& status, std::chrono::seconds more) {
    tell("EXTEND_TIMEOUT_USEC=" + std::to_string(std::chrono::microseconds(more).count()) +
         "\nSTATUS=" + one_line(status));
}

void tell_alive() {
    tell("WATCHDOG=1");
}

}  // namespace camdir::service
