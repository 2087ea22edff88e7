// hand-over: what an observer sees when a director or the game server dies, stops, hangs or comes back.
#include <sys/ptrace.h>
#include <sys/wait.h>

#include <CLI/CLI.hpp>
#include <atomic>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iomanip>
#include <iostream>
#include <mutex>
#include <thread>

#include "evaluation/resample.hpp"
#include "hand_over_record.hpp"
#include "support/child_process.hpp"
#include "support/eventually.hpp"
#include "support/http_client.hpp"
#include "support/temporary_folder.hpp"
#include "support/test_domain.hpp"

namespace camdir::soak {
namespace {

using std::chrono::milliseconds;
using test::ChildProcess;

constexpr double rate_hz = 60.0;
constexpr std::uint32_t player = 0;
constexpr milliseconds absence{6000};
constexpr milliseconds long_absence{12'000};  // DDS forgets who is silent for 10 s
constexpr milliseconds afterwards{4000};      // at least so long is measured

struct Options {
    std::string programs = CAMDIR_BIN_DIR;
    std::string map;     // baked
    std::string source;  // of it
    std::string trace;
    double delay_s = 0.0;
    double seconds = 10.0;
    int runs = 1;
    std::string only;
    double longest_gap_ms = 450.0;  // the lease and as much again, for a busy machine
    bool logs = false;
};

double now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// A director as a process of its own; the leader has index 0, the standby index 1.
class DirectorProcess {
  public:
    DirectorProcess(std::string program, const std::filesystem::path& folder, std::uint32_t domain, int index)
        : program_(std::move(program)),
          file_(folder / ("director-" + std::to_string(index) + ".json")),
          token_file_(folder / "token"),
          domain_(domain),
          index_(index) {}

    void start(const std::string& map_file, const std::string& source) {
        std::ofstream(token_file_) << token << '\n';
        std::filesystem::permissions(token_file_, std::filesystem::perms(0600));
        std::ofstream(file_) << R"({"dds": {"domain": )" << domain_ << R"(, "participant_index": )" << index_
                             << R"(, "peers": [")" << test::director_address(domain_, 1 - index_)
                             << R"("], "strength": )" << (index_ == 0 ? 200 : 100) << R"(, "director_id": )"
                             << 10 * (index_ + 1) << R"(}, "http": {"port": 0, "token_file": ")"
                             << token_file_.string() << R"("}, "maps": [{"name": "map", "file": ")"
                             << map_file << R"(", "source": ")" << source << R"("}]})";
        process_ = std::make_unique<ChildProcess>(
            std::vector<std::string>{program_, "serve", "--config", file_.string()});
    }
    void hand_over() const {
        const auto answer =
            test::HttpClient(http_port())
                .ask("POST", "/hand-over", "Authorization: Bearer " + std::string(token) + "\r\n");
        if (answer.status != 200) throw std::runtime_error("POST /hand-over: " + answer.body);
    }
    void stop() { process_.reset(); }
    void signal(int number) const { process_->send_signal(number); }
    void wait() { process_->wait(); }
    [[nodiscard]] pid_t pid() const { return process_->pid(); }
    [[nodiscard]] std::string log() const { return process_ ? process_->errors() : ""; }

  private:
    static constexpr const char* token = "hand-over";

    [[nodiscard]] int http_port() const {
        const std::string before = "http: listening on 127.0.0.1 port ";
        const std::string lines = log();
        const std::size_t found = lines.find(before);
        if (found == std::string::npos) throw std::runtime_error("no HTTP port in the log: " + lines);
        return std::stoi(lines.substr(found + before.size()));
    }

    std::string program_;
    std::filesystem::path file_, token_file_;
    std::uint32_t domain_;
    int index_;
    std::unique_ptr<ChildProcess> process_;
};

std::vector<pid_t> workers_of(pid_t process) {
    std::vector<pid_t> workers;
    const std::filesystem::path tasks = "/proc/" + std::to_string(process) + "/task";
    for (const auto& task : std::filesystem::directory_iterator(tasks)) {
        std::string name;
        std::ifstream(task.path() / "comm") >> name;
        if (name.starts_with("worker-")) workers.push_back(std::stoi(task.path().filename()));
    }
    return workers;
}

// One thread must stop and release them.
void hang_workers(pid_t process, milliseconds duration) {
    const auto workers = workers_of(process);
    for (const pid_t worker : workers) {
        ::ptrace(PTRACE_SEIZE, worker, nullptr, nullptr);
        ::ptrace(PTRACE_INTERRUPT, worker, nullptr, nullptr);
        ::waitpid(worker, nullptr, __WALL);
    }
    std::this_thread::sleep_for(duration);
    for (const pid_t worker : workers)
        ::ptrace(PTRACE_DETACH, worker, nullptr, nullptr);
}

class Stage {
  public:
    Stage(const Options& options, const evaluation::Trace& trace)
        : options_(options), record_(trace, rate_hz, player) {
        leader.emplace(options_.programs + "/camera-director", folder_.path(), domain_.id(), 0);
        standby.emplace(options_.programs + "/camera-director", folder_.path(), domain_.id(), 1);
    }
    ~Stage() { reading_ = {}; }

    void start_leader() { leader->start(options_.map, ""); }
    void start_standby() { standby->start(options_.map, ""); }
    void start_game() {
        game.reset();
        game = std::make_unique<ChildProcess>(std::vector<std::string>{
            options_.programs + "/pose-replay", options_.trace, "--domain", std::to_string(domain_.id()),
            "--directors", directors(), "--match-prefix", "game", "--map-name", "map", "--rate", "60",
            "--delay", std::to_string(options_.delay_s)});
    }
    void start_observer() {
        context_ = camera_director::Context::open({.domain = domain_.id(), .directors = directors()}).value();
        observer_ = camera_director::Observer::open(*context_, "game-0", "viewer").value();
        observer_->request({.target = player}).value();
        reading_ = std::jthread([this](const std::stop_token& stop) { read(stop); });
    }
    void await_leader() {
        const bool served = test::eventually([&] { return director() == 10; });
        if (!served) std::cerr << "the leader does not serve\n" << leader->log();
    }
    void begin() {
        const std::lock_guard lock(mutex_);
        record_.begin(now());
    }
    HandOver finish() {
        const std::lock_guard lock(mutex_);
        return record_.finish(now());
    }
    [[nodiscard]] std::optional<std::uint64_t> director() {
        const std::lock_guard lock(mutex_);
        return record_.director();
    }
    void return_while_the_map_is_baked() { leader->start(folder_ / "late.vfs", options_.source); }
    void pause_observer(milliseconds duration) {
        const std::lock_guard lock(mutex_);
        std::this_thread::sleep_for(duration);
    }

    std::optional<DirectorProcess> leader, standby;
    std::unique_ptr<ChildProcess> game;

  private:
    [[nodiscard]] std::string directors() const {
        return test::director_address(domain_.id(), 0) + ", " + test::director_address(domain_.id(), 1);
    }
    void read(const std::stop_token& stop) {
        std::vector<camera_director::Camera> cameras(CDIR_MAX_CAMERAS);
        while (!stop.stop_requested()) {
            if (observer_->wait(milliseconds(100)).value() != camera_director::Waited::arrived) continue;
            const std::lock_guard lock(mutex_);
            while (const auto frame = observer_->next_frame(cameras).value()) {
                const auto status = observer_->shot_status().value();
                const auto end = cameras.begin() + frame->camera_count;
                const auto own = std::find_if(cameras.begin(), end, [&](const auto& camera) {
                    return camera.camera_id == status.camera_id;
                });
                record_.add(*frame, status.camera_id == 0 || own == end ? nullptr : &*own, now());
            }
        }
    }

    const Options& options_;
    test::TestDomain domain_;
    test::TemporaryFolder folder_;
    std::mutex mutex_;
    HandOverRecord record_;
    std::optional<camera_director::Context> context_;
    std::optional<camera_director::Observer> observer_;
    std::jthread reading_;
};

struct Row {
    std::string name;
    std::function<void(Stage&)> happens;
    bool from_start = false;   // measures from the first frame
    double more_gap_ms = 0.0;  // where it is not the directors' fault
    std::uint64_t forced = 0;  // cuts where the game's own poses jump
};

std::vector<Row> rows() {
    const auto pause = [] { std::this_thread::sleep_for(absence); };
    return {
        {"nothing", [](Stage&) {}},
        {"leader killed", [](Stage& s) { s.leader->signal(SIGKILL); }},
        {"leader SIGTERM", [](Stage& s) { s.leader->signal(SIGTERM); }},
        {"leader hands over", [](Stage& s) { s.leader->hand_over(); }},
        {"leader stopped 6 s",
         [=](Stage& s) {
             s.leader->signal(SIGSTOP);
             pause();
             s.leader->signal(SIGCONT);
         }},
        {"leader stopped 12 s",
         [](Stage& s) {
             s.leader->signal(SIGSTOP);
             std::this_thread::sleep_for(long_absence);
             s.leader->signal(SIGCONT);
         }},
        {"leader killed, back",
         [=](Stage& s) {
             s.leader->signal(SIGKILL);
             s.leader->wait();
             pause();
             s.start_leader();
         }},
        {"both start together", [](Stage&) {}, true},
        {"leader back, baking",
         [=](Stage& s) {
             s.leader->signal(SIGKILL);
             s.leader->wait();
             std::this_thread::sleep_for(milliseconds(1000));
             s.return_while_the_map_is_baked();
         }},
        {"standby stopped 6 s",
         [=](Stage& s) {
             s.standby->signal(SIGSTOP);
             pause();
             s.standby->signal(SIGCONT);
         }},
        {"standby killed", [](Stage& s) { s.standby->signal(SIGKILL); }},
        {"leader's workers hang 6 s", [](Stage& s) { hang_workers(s.leader->pid(), absence); }},
        {"observer late 1 s", [](Stage& s) { s.pause_observer(milliseconds(1000)); }, false, 1000.0},
        {"game stopped 6 s",
         [=](Stage& s) {
             s.game->send_signal(SIGSTOP);
             pause();
             s.game->send_signal(SIGCONT);
         },
         false, 6000.0, 1},
        {"game restarted",
         [](Stage& s) {
             s.game->send_signal(SIGKILL);
             s.game->wait();
             s.start_game();
         },
         false, 1000.0},
    };
}

HandOver play(const Row& row, const Options& options, const evaluation::Trace& trace) {
    Stage stage(options, trace);
    if (row.from_start) {
        stage.start_game();
        stage.start_observer();
        stage.begin();
        stage.start_leader();
        stage.start_standby();
    } else {
        stage.start_leader();
        stage.start_game();
        stage.start_observer();
        stage.await_leader();
        stage.start_standby();
        // Both know all there is to know.
        std::this_thread::sleep_for(std::chrono::duration<double>(2.5 + options.delay_s));
        stage.begin();
    }
    const double planned = now() + options.seconds;
    row.happens(stage);
    const double end = std::max(planned, now() + std::chrono::duration<double>(afterwards).count());
    while (now() < end)
        std::this_thread::sleep_for(milliseconds(20));
    const HandOver found = stage.finish();
    if (options.logs)
        std::cerr << "-- leader\n" << stage.leader->log() << "-- standby\n" << stage.standby->log();
    return found;
}

// What no viewer should see; empty when there was none of it.
std::string fault(const HandOver& found, const Row& row, const Options& options) {
    constexpr double longest_silence_s = 1.0;
    constexpr double farthest_leap = 40.0;  // cameras turn round a player faster than the player moves
    if (found.silent_s > longest_silence_s) return "no cameras any more";
    if (found.stale > 0) return "stale frames";
    if (found.unforced > row.forced) return "a cut without a reason";
    if (found.leap > farthest_leap) return "a jump";
    if (found.gap_ms > options.longest_gap_ms + row.more_gap_ms) return "a long gap";
    return "";
}

int run(const Options& options) {
    auto read = evaluation::read_trace(options.trace);
    if (read) read = evaluation::resample(*read, rate_hz);
    if (!read) {
        std::cerr << "hand-over: " << read.error().message << '\n';
        return 1;
    }
    std::cout << std::left << std::setw(28) << "done" << std::right << std::setw(8) << "gap ms"
              << std::setw(6) << "lost" << std::setw(6) << "stale" << std::setw(9) << "changes"
              << std::setw(9) << "unforced" << std::setw(8) << "leap" << std::setw(9) << "no shot"
              << "  fault" << std::endl;
    bool flawless = true;
    for (const Row& row : rows()) {
        if (row.name.find(options.only) == std::string::npos) continue;
        for (int i = 0; i < options.runs; ++i) {
            const HandOver found = play(row, options, *read);
            std::cout << std::left << std::setw(28) << row.name << std::right << std::fixed
                      << std::setprecision(0) << std::setw(8) << found.gap_ms << std::setw(6) << found.lost
                      << std::setw(6) << found.stale << std::setw(9) << found.changes << std::setw(9)
                      << found.unforced << std::setprecision(1) << std::setw(8) << found.leap << std::setw(9)
                      << found.unanswered << "  " << fault(found, row, options) << std::endl;
            flawless = flawless && fault(found, row, options).empty();
        }
    }
    return flawless ? 0 : 1;
}

}  // namespace
}  // namespace camdir::soak

int main(int argc, char** argv) {
    using namespace camdir;
    soak::Options options;
    CLI::App app("What an observer sees when directors and game servers die, stop, hang or come back.",
                 "hand-over");
    app.add_option("map", options.map, "MAP.vfs")->required();
    app.add_option("source", options.source, "The map that it was baked from")->required();
    app.add_option("trace", options.trace, "Recorded match that is replayed, CSV or CSV.gz")->required();
    app.add_option("--bin", options.programs, "Folder of the programs")->capture_default_str();
    app.add_option("--delay", options.delay_s, "Spectator delay, s")->capture_default_str();
    app.add_option("--seconds", options.seconds, "Measured in each row")->capture_default_str();
    app.add_option("--runs", options.runs, "Of each row")->capture_default_str();
    app.add_option("--only", options.only, "Rows whose name contains this");
    app.add_option("--max-gap", options.longest_gap_ms, "A longer gap is a fault, ms")->capture_default_str();
    app.add_flag("--logs", options.logs, "Shows the directors' logs");
    CLI11_PARSE(app, argc, argv);
    try {
        return soak::run(options);
    } catch (const std::exception& error) {
        std::cerr << "hand-over: " << error.what() << '\n';
        return 1;
    }
}
