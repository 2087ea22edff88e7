#include "service/interruption.hpp"

#include <pthread.h>
#include <unistd.h>

#include <ctime>

namespace camdir::service {

Interruption::Interruption() {
    sigemptyset(&signals_);
    sigaddset(&signals_, SIGINT);
    sigaddset(&signals_, SIGTERM);
    pthread_sigmask(SIG_BLOCK, &signals_, &mask_before_);
    waiter_ = std::jthread([this](const std::stop_token& done) {
        const timespec patience{0, 50'000'000};
        while (!done.stop_requested()) {
            if (sigtimedwait(&signals_, nullptr, &patience) < 0) continue;
            if (!requested_.request_stop()) ::_exit(exit_interrupted);
        }
    });
}

Interruption::~Interruption() {
    waiter_.request_stop();
    waiter_.join();
    pthread_sigmask(SIG_SETMASK, &mask_before_, nullptr);
}

}  // namespace camdir::service
