#include "service/signals.hpp"

#include <pthread.h>

#include <ctime>

namespace camdir::service {

Signals::Signals() {
    sigemptyset(&waited_for_);
    for (const int signal : {SIGTERM, SIGINT, SIGHUP})
        sigaddset(&waited_for_, signal);
    pthread_sigmask(SIG_BLOCK, &waited_for_, &mask_before_);
    std::signal(SIGPIPE, SIG_IGN);
}

Signals::~Signals() {
    pthread_sigmask(SIG_SETMASK, &mask_before_, nullptr);
}

Signal Signals::wait(std::chrono::milliseconds patience) {
    const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(patience);
    const timespec limit{static_cast<std::time_t>(seconds.count()),
                         static_cast<long>(std::chrono::nanoseconds(patience - seconds).count())};
    switch (sigtimedwait(&waited_for_, nullptr, &limit)) {
        case SIGTERM:
        case SIGINT:
            return Signal::stop;
        case SIGHUP:
            return Signal::reload;
        default:
            return Signal::none;
    }
}

}  // namespace camdir::service
