#include "base/signals.hpp"

#include <pthread.h>
#include <unistd.h>

#include <ctime>
#include <initializer_list>

namespace camdir {
namespace {

// Blocks them for this thread and those that it starts; returns the mask before.
sigset_t block(std::initializer_list<int> numbers, sigset_t& signals) {
    sigemptyset(&signals);
    for (const int number : numbers)
        sigaddset(&signals, number);
    sigset_t mask_before{};
    pthread_sigmask(SIG_BLOCK, &signals, &mask_before);
    return mask_before;
}

// The number of the signal, or -1 when none came.
int wait_for(const sigset_t& signals, std::chrono::milliseconds timeout) {
    const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(timeout);
    const timespec limit{static_cast<std::time_t>(seconds.count()),
                         static_cast<long>(std::chrono::nanoseconds(timeout - seconds).count())};
    return sigtimedwait(&signals, nullptr, &limit);
}

}  // namespace

Interruption::Interruption() : mask_before_(block({SIGINT, SIGTERM}, signals_)) {
    waiter_ = std::jthread([this](const std::stop_token& done) {
        while (!done.stop_requested()) {
            if (wait_for(signals_, std::chrono::milliseconds(50)) < 0) continue;
            if (!requested_.request_stop()) ::_exit(exit_interrupted);
        }
    });
}

Interruption::~Interruption() {
    waiter_.request_stop();
    waiter_.join();
    pthread_sigmask(SIG_SETMASK, &mask_before_, nullptr);
}

Signals::Signals() : mask_before_(block({SIGTERM, SIGINT, SIGHUP}, signals_)) {
    std::signal(SIGPIPE, SIG_IGN);
    // A file that may not grow is an error of its writer.
    std::signal(SIGXFSZ, SIG_IGN);
}

Signals::~Signals() {
    // Whoever asked again has what they wanted.
    while (wait_for(signals_, std::chrono::milliseconds(0)) >= 0) {
    }
    pthread_sigmask(SIG_SETMASK, &mask_before_, nullptr);
}

Signal Signals::wait(std::chrono::milliseconds timeout) {
    switch (wait_for(signals_, timeout)) {
        case SIGTERM:
        case SIGINT:
            return Signal::stop;
        case SIGHUP:
            return Signal::reload;
        default:
            return Signal::none;
    }
}

}  // namespace camdir
