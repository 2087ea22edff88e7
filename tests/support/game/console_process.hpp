// A program with a console on its standard input and output: the game's server and client.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "support/child_process.hpp"
#include "support/temporary_folder.hpp"

namespace camdir::test {

class ConsoleProcess {
  public:
    explicit ConsoleProcess(const std::vector<std::string>& command);
    ~ConsoleProcess();
    ConsoleProcess(const ConsoleProcess&) = delete;
    ConsoleProcess& operator=(const ConsoleProcess&) = delete;

    // Enters lines.
    void enter(const std::string& lines);
    // Enters a line and returns what is printed until it has been executed, or until the program ends. Throws
    // when neither happens.
    [[nodiscard]] std::string ask(const std::string& line);

    // What it has printed, errors included.
    [[nodiscard]] std::string output() const { return process_.output(); }
    [[nodiscard]] pid_t pid() const { return process_.pid(); }
    [[nodiscard]] bool runs();
    // Ends it by its own `quit`. Returns the exit code, or minus the signal's number.
    int quit();

  private:
    TemporaryFolder folder_;
    ChildProcess process_;
    int input_;
    int questions_ = 0;
    std::optional<int> ended_;
};

}  // namespace camdir::test
