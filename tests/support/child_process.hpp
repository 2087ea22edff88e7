// Child processes of tests.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <optional>
#include <string>
#include <vector>

namespace camdir::test {

// Runs one program with its output in temporary files. The destructor kills it if it still runs.
class ChildProcess {
  public:
    explicit ChildProcess(const std::vector<std::string>& command);
    ~ChildProcess();
    ChildProcess(const ChildProcess&) = delete;
    ChildProcess& operator=(const ChildProcess&) = delete;

    [[nodiscard]] pid_t pid() const { return pid_; }
    void send_signal(int number) const;
    // Waits for the process to end. Returns the exit code, or minus the signal's number.
    int wait();
    // The same, for at most `limit`; nullopt when the process still runs.
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
