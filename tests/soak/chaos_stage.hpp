// The processes of a run of chaos, and what is done to them.
#pragma once

#include <array>
#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "director_process.hpp"
#include "support/child_process.hpp"
#include "support/temporary_folder.hpp"
#include "support/test_domain.hpp"
#include "timeline.hpp"
#include "witness.hpp"

namespace camdir::soak {

// Sleeps, but not longer than until a stop is requested.
void sleep_for(double seconds, const std::stop_token& stop);

// Directors, real matches with players that walk and never jump, and their observers. Thread-safe.
class ChaosStage {
  public:
    struct Options {
        std::string programs;  // folder
        std::string map;       // baked
    };

    // Starts all of them and returns when all observers are served. Throws when they are not.
    ChaosStage(const Options& options, const Scenario& scenario);

    // Carries the act out and waits for its end, with times of `now`. Acts on directors wait for each other,
    // and until all directors know what there is to know.
    [[nodiscard]] ActRecord perform(const Act& act, const std::function<double()>& now,
                                    const std::stop_token& stop);

    [[nodiscard]] Witness& witness() { return *witness_; }
    [[nodiscard]] std::array<std::optional<Usage>, 2> usages();
    // After the last act. Ends the directors and the game server; returns what was wrong, empty if nothing.
    [[nodiscard]] std::string end();
    [[nodiscard]] std::string logs();

  private:
    struct Place {
        std::optional<DirectorProcess> director;
        pid_t process = 0;
    };

    void start(Place& place);
    void start_game();
    void start_witness();
    [[nodiscard]] Place& place_of(Role role);
    void act_on_director(const Act& act, const std::stop_token& stop);
    void act_as_stranger(ActRecord& record, const std::stop_token& stop);
    void restart(Place& place, const Act& act, const std::stop_token& stop);
    void freeze_observer(const Act& act, const std::stop_token& stop);
    [[nodiscard]] std::uint64_t run_stranger(const Act& act, const std::stop_token& stop);
    void run_crowd(ActRecord& record, const std::stop_token& stop);
    [[nodiscard]] std::string directors() const;

    const Options options_;
    const Scenario scenario_;
    test::TestDomain domain_;
    test::TemporaryFolder folder_;
    std::mutex acting_;     // guards the directors
    std::mutex processes_;  // guards their process numbers
    std::vector<Place> places_;
    std::unique_ptr<test::ChildProcess> game_;
    std::unique_ptr<Witness> witness_;
    std::atomic<std::uint32_t> strangers_{0};
};

}  // namespace camdir::soak
