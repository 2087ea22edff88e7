#include "director_process.hpp"

#include <sys/ptrace.h>
#include <sys/wait.h>

#include <fstream>
#include <stdexcept>
#include <thread>

#include "support/http_client.hpp"

namespace camdir::soak {
namespace {

constexpr const char* token = "hand-over";

std::vector<pid_t> threads_of(pid_t process, const std::string& name) {
    std::vector<pid_t> threads;
    const std::filesystem::path tasks = "/proc/" + std::to_string(process) + "/task";
    for (const auto& task : std::filesystem::directory_iterator(tasks)) {
        std::string own_name;
        std::ifstream(task.path() / "comm") >> own_name;
        if (own_name.starts_with(name)) threads.push_back(std::stoi(task.path().filename()));
    }
    return threads;
}

}  // namespace

DirectorProcess::DirectorProcess(Setting setting)
    : setting_(std::move(setting)),
      file_(setting_.folder / ("director-" + std::to_string(setting_.index) + ".json")),
      token_file_(setting_.folder / "token") {}

void DirectorProcess::start(const std::string& map_file, const std::string& source) {
    std::ofstream(token_file_) << token << '\n';
    std::filesystem::permissions(token_file_, std::filesystem::perms(0600));
    // A flood's participant may take all places: that is harder than what it may by default.
    std::ofstream(file_)
        << R"({"limits": {"participant_matches": 64, "participant_observers": 256}, "dds": {"domain": )"
        << setting_.domain << R"(, "interface": ")" << setting_.interface << R"(", "insecure": )"
        << (setting_.insecure ? "true" : "false") << R"(, "participant_index": )" << setting_.index
        << R"(, "peers": [")" << setting_.peer << R"("], "strength": )" << (setting_.index == 0 ? 200 : 100)
        << R"(, "director_id": )" << id_of(setting_.index) << R"(}, "http": {"port": 0, "token_file": ")"
        << token_file_.string() << R"("}, "matches": {"forget_s": )" << setting_.forget_s
        << R"(}, "maps": [{"name": "map", "file": ")" << map_file << R"(", "source": ")" << source
        << R"("}]})";
    std::vector<std::string> command = setting_.command;
    command.insert(command.end(), {"serve", "--config", file_.string()});
    process_ = std::make_unique<test::ChildProcess>(command);
}

bool DirectorProcess::hand_over() const {
    const int port = http_port();
    if (port == 0) throw std::runtime_error("no HTTP port in the log: " + log());
    const auto answer = test::HttpClient(port).ask("POST", "/hand-over",
                                                   "Authorization: Bearer " + std::string(token) + "\r\n");
    if (answer.status != 200 && answer.status != 409)
        throw std::runtime_error("POST /hand-over: " + answer.body);
    return answer.status == 200;
}

bool DirectorProcess::is_ready() const {
    const int port = http_port();
    return port != 0 && test::HttpClient(port).ask("GET", "/-/ready").status == 200;
}

// One thread must stop and release them.
void DirectorProcess::hang_threads(const std::string& name, std::chrono::milliseconds duration) const {
    const auto threads = threads_of(process_->pid(), name);
    if (threads.empty()) throw std::runtime_error("the director has no thread " + name);
    for (const pid_t thread : threads) {
        ::ptrace(PTRACE_SEIZE, thread, nullptr, nullptr);
        ::ptrace(PTRACE_INTERRUPT, thread, nullptr, nullptr);
        ::waitpid(thread, nullptr, __WALL);
    }
    std::this_thread::sleep_for(duration);
    for (const pid_t thread : threads)
        ::ptrace(PTRACE_DETACH, thread, nullptr, nullptr);
}

int DirectorProcess::http_port() const {
    const std::string before = "http: listening on 127.0.0.1 port ";
    const std::string lines = log();
    const std::size_t found = lines.find(before);
    return found == std::string::npos ? 0 : std::stoi(lines.substr(found + before.size()));
}

}  // namespace camdir::soak
