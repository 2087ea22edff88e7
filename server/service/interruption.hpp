// Ctrl-C while a command works.
#pragma once

#include <csignal>
#include <stop_token>
#include <thread>

namespace camdir::service {

// Exit code of an interrupted program: 128 + SIGINT, as of a shell.
inline constexpr int exit_interrupted = 130;

// While it lives, SIGINT and SIGTERM request a stop instead of ending the process; a second one ends it at
// once with exit code 130. Make it before any other thread: threads inherit its signal mask.
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

}  // namespace camdir::service
