// A leader and a standby that serve a replayed match to one observer, and what may be done to them.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "director_process.hpp"
#include "evaluation/trace.hpp"
#include "hand_over_record.hpp"
#include "hosts.hpp"
#include "support/child_process.hpp"
#include "support/temporary_folder.hpp"
#include "support/test_domain.hpp"

namespace camdir::soak {

// Steps the time of day of one process, of those that it starts with command().
class StepClock {
  public:
    // Whether this machine has what it takes.
    [[nodiscard]] static bool available();

    // `file` says what time it is.
    explicit StepClock(std::filesystem::path file);
    // The same command with this clock.
    [[nodiscard]] std::vector<std::string> command(std::vector<std::string> command) const;
    // From the machine's.
    void step(std::chrono::seconds by) const;

  private:
    std::filesystem::path file_;
};

class Stage {
  public:
    struct Options {
        std::string programs = CAMDIR_BIN_DIR;
        std::string map;     // baked
        std::string source;  // of it
        std::string trace;
        double delay_s = 0.0;
    };
    // Where the programs run on hosts of their own.
    enum Host { clients, leaders, standbys, host_count };

    static constexpr double rate_hz = 60.0;
    static constexpr std::uint32_t player = 0;

    // `hosts`: null where all are to run on one host. `steps_clocks`: the leader and the game server have
    // clocks of their own.
    Stage(const Options& options, const evaluation::Trace& trace, Hosts* hosts, bool steps_clocks);
    ~Stage();

    void start_leader() { start(*leader, leaders, options_.map, ""); }
    void start_standby() { start(*standby, standbys, options_.map, ""); }
    void start_game();
    void start_observer();
    void await_leader();
    void begin();
    [[nodiscard]] HandOver finish();
    void return_while_the_map_is_baked() { start(*leader, leaders, folder_ / "late.vfs", options_.source); }
    void pause_observer(std::chrono::milliseconds duration);
    // What one sends to the other is lost for that long; both ways where both are given.
    struct Way {
        Host from, to;
    };
    void cut(const std::vector<Way>& ways, std::chrono::milliseconds duration);

    std::optional<DirectorProcess> leader, standby;
    std::unique_ptr<test::ChildProcess> game;
    std::optional<StepClock> leader_clock, game_clock;

  private:
    [[nodiscard]] DirectorProcess::Setting setting(int index) const;
    void start(DirectorProcess& director, Host host, const std::string& map, const std::string& source);
    [[nodiscard]] std::string interface_of(Host host) const;
    [[nodiscard]] std::string address_of(int director) const;
    [[nodiscard]] std::string directors() const { return address_of(0) + ", " + address_of(1); }
    [[nodiscard]] std::optional<std::uint64_t> serving_director();
    void read(const std::stop_token& stop);

    const Options& options_;
    Hosts* const hosts_;
    test::TestDomain domain_;
    test::TemporaryFolder folder_;
    std::mutex mutex_;  // guards the record and reading
    HandOverRecord record_;
    std::optional<camera_director::Context> context_;
    std::optional<camera_director::Observer> observer_;
    std::jthread reading_;
};

}  // namespace camdir::soak
