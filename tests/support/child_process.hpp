// Programs that a test starts.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <optional>
#include <string>
#include <vector>

namespace camdir::test {

// Runs one program; its output goes to temporary files. Killed when the object ends before it does.
class ChildProcess {
  public:
    explicit ChildProcess(const std::vector<std::string>& command);
    ~ChildProcess();
    ChildProcess(const ChildProcess&) = delete;
    ChildProcess& operator=(const ChildProcess&) = delete;

    void send_signal(int number) const;
    // Waits for its end. The exit code, or minus the signal's number.
    int wait();
    // Waits at most `limit`; nothing when it runs on.
    std::optional<int> wait_for(std::chrono::milliseconds limit);

    [[nodiscard]] std::string output() const;  // so far
    [[nodiscard]] std::string errors() const;

  private:
    int ended(int status);

    int output_;
    int errors_;
    pid_t pid_ = -1;
};

}  // namespace camdir::test
