// A director as a process of its own, beside at most one other.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "support/child_process.hpp"

namespace camdir::soak {

// One thread at a time.
class DirectorProcess {
  public:
    struct Setting {
        std::vector<std::string> command;  // camera-director, without arguments
        std::filesystem::path folder;      // for its configuration
        std::uint32_t domain = 0;
        int index = 0;                 // 0 leads where both begin together, 1 stands by
        std::string peer;              // HOST:PORT at which the other one is found
        std::string interface = "lo";  // of DDS
        bool insecure = false;         // DDS may leave loopback
        double forget_s = 300.0;       // until a match whose game server disappeared ends
    };

    explicit DirectorProcess(Setting setting);

    [[nodiscard]] static std::uint64_t id_of(int index) {
        return 10 * (static_cast<std::uint64_t>(index) + 1);
    }

    // It serves one map, whose name is "map"; `source` may be empty.
    void start(const std::string& map_file, const std::string& source);
    // False when it keeps matches for want of a standby. Throws when the director refuses.
    [[nodiscard]] bool hand_over() const;
    // Whether it says that it serves.
    [[nodiscard]] bool is_ready() const;
    // Stops its threads whose name begins so for that long. Throws when there is none.
    void hang_threads(const std::string& name, std::chrono::milliseconds duration) const;
    void signal(int number) const { process_->send_signal(number); }
    // Returns the exit code, or minus the signal's number.
    int wait() { return process_->wait(); }
    [[nodiscard]] pid_t pid() const { return process_->pid(); }
    [[nodiscard]] std::string log() const { return process_ ? process_->errors() : ""; }

  private:
    // 0 as long as it does not listen.
    [[nodiscard]] int http_port() const;

    Setting setting_;
    std::filesystem::path file_, token_file_;
    std::unique_ptr<test::ChildProcess> process_;
};

}  // namespace camdir::soak
