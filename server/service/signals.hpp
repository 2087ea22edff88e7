// The signals that a service acts on.
#pragma once

#include <chrono>
#include <csignal>

namespace camdir::service {

enum class Signal { none, stop, reload };

// While it lives, SIGTERM, SIGINT and SIGHUP wait to be asked for, and SIGPIPE is ignored. Make it before any
// other thread: threads inherit the mask.
class Signals {
  public:
    Signals();
    Signals(const Signals&) = delete;
    Signals& operator=(const Signals&) = delete;
    ~Signals();

    // The next one, or none within `patience`.
    [[nodiscard]] Signal wait(std::chrono::milliseconds patience);

  private:
    sigset_t waited_for_{};
    sigset_t mask_before_{};
};

}  // namespace camdir::service
