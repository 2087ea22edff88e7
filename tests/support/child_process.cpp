#include "support/child_process.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>

#include "support/eventually.hpp"

extern char** environ;

namespace camdir::test {

namespace {

// Unlinked at once, so that nothing is left behind.
int open_temporary() {
    std::string pattern = (std::filesystem::temp_directory_path() / "camdir-child-XXXXXX").string();
    const int file = mkstemp(pattern.data());
    if (file < 0) throw std::runtime_error("cannot create a temporary file");
    unlink(pattern.c_str());
    return file;
}

std::string content(int file) {
    std::string text;
    std::array<char, 4096> part{};
    ssize_t count = 0;
    while ((count = pread(file, part.data(), part.size(), static_cast<off_t>(text.size()))) > 0) {
        text.append(part.data(), static_cast<std::size_t>(count));
    }
    return text;
}

}  // namespace

ChildProcess::ChildProcess(const std::vector<std::string>& command)
    : output_(open_temporary()), errors_(open_temporary()) {
    std::vector<char*> arguments;
    for (const std::string& argument : command) {
        arguments.push_back(const_cast<char*>(argument.c_str()));
    }
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, output_, STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, errors_, STDERR_FILENO);
    const int failed = posix_spawn(&pid_, arguments[0], &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (failed != 0) throw std::runtime_error("cannot start " + command[0]);
}

ChildProcess::~ChildProcess() {
    if (pid_ > 0) {
        send_signal(SIGKILL);
        wait();
    }
    close(output_);
    close(errors_);
}

void ChildProcess::send_signal(int number) const {
    kill(pid_, number);
}

int ChildProcess::wait() {
    int status = 0;
    waitpid(pid_, &status, 0);
    return ended(status);
}

std::optional<int> ChildProcess::wait_for(std::chrono::milliseconds limit) {
    int status = 0;
    if (!eventually([&] { return waitpid(pid_, &status, WNOHANG) == pid_; }, limit)) return std::nullopt;
    return ended(status);
}

int ChildProcess::ended(int status) {
    pid_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

std::string ChildProcess::output() const {
    return content(output_);
}

std::string ChildProcess::errors() const {
    return content(errors_);
}

}  // namespace camdir::test
