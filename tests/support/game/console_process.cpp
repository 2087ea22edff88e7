#include "support/game/console_process.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <stdexcept>

#include "support/eventually.hpp"

namespace camdir::test {
namespace {

// The shell opens the pipe for reading and writing, so that it neither waits for the other end nor sees it
// close.
std::vector<std::string> with_input(const std::filesystem::path& pipe,
                                    const std::vector<std::string>& command) {
    if (::mkfifo(pipe.c_str(), 0600) != 0) throw std::runtime_error("cannot create " + pipe.string());
    std::vector<std::string> whole = {"/bin/sh", "-c", R"(exec "$@" <>"$0" 2>&1)", pipe.string()};
    whole.insert(whole.end(), command.begin(), command.end());
    return whole;
}

}  // namespace

ConsoleProcess::ConsoleProcess(const std::vector<std::string>& command)
    : process_(with_input(folder_ / "input", command)),
      input_(::open((folder_ / "input").c_str(), O_RDWR | O_CLOEXEC)) {
    if (input_ < 0) throw std::runtime_error("cannot open " + (folder_ / "input").string());
}

ConsoleProcess::~ConsoleProcess() {
    ::close(input_);
}

bool ConsoleProcess::runs() {
    if (!ended_) ended_ = process_.wait_for(std::chrono::milliseconds(0));
    return !ended_;
}

int ConsoleProcess::quit() {
    if (!runs()) return *ended_;
    enter("quit");
    ended_ = process_.wait_for(patience);
    if (!ended_) throw std::runtime_error("does not end: " + output());
    return *ended_;
}

void ConsoleProcess::enter(const std::string& lines) {
    const std::string text = lines + "\n";
    if (::write(input_, text.data(), text.size()) != static_cast<ssize_t>(text.size()))
        throw std::runtime_error("cannot enter '" + lines + "'");
}

std::string ConsoleProcess::ask(const std::string& line) {
    const std::string end = "end-of-answer-" + std::to_string(questions_++);
    const std::size_t before = output().size();
    enter(line + "\necho " + end);
    std::string answer;
    if (!eventually([&] {
            answer = output().substr(before);
            return answer.find(end) != std::string::npos || !runs();
        }))
        throw std::runtime_error("no answer to '" + line + "': " + answer);
    return answer.substr(0, answer.find(end));
}

}  // namespace camdir::test
