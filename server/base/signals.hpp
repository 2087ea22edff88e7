// SIGINT, SIGTERM and SIGHUP. Both classes block the signals that they handle: make one before any other
// thread, because threads inherit the signal mask.
#pragma once

#include <chrono>
#include <csignal>
#include <stop_token>
#include <thread>

namespace camdir {

// Exit code of an interrupted program: 128 + SIGINT, as a shell reports it.
inline constexpr int exit_interrupted = 130;

// For a program that works to an end: while it lives, SIGINT and SIGTERM request a stop instead of ending the
// process; a second signal ends it at once with exit_interrupted.
class Interruption {
  public:
    Interruption();
    Interruption(const Interruption&) = delete;
    Interruption& operator=(const Interruption&) = delete;
    ~Interruption();

    [[nodiscard]] std::stop_token token() const { return requested_.get_token(); }

  private:
    sigset_t signals_{};
    sigset_t mask_before_{};
    std::stop_source requested_;
    std::jthread waiter_;
};

enum class Signal { none, stop, reload };

// For a service: while it lives, SIGTERM, SIGINT and SIGHUP are queued for wait(); from then on SIGPIPE and
// SIGXFSZ are ignored.
class Signals {
  public:
    Signals();
    Signals(const Signals&) = delete;
    Signals& operator=(const Signals&) = delete;
    ~Signals();

    // The next one, or none within `timeout`.
    [[nodiscard]] Signal wait(std::chrono::milliseconds timeout);

  private:
    sigset_t signals_{};
    sigset_t mask_before_{};
};

}  // namespace camdir
