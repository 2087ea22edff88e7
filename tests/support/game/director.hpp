// A real director for a game on this machine.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "support/child_process.hpp"
#include "support/temporary_folder.hpp"

namespace camdir::test {

// `camera-director serve` with maps of the game, which it bakes when no earlier test has.
class GameDirector {
  public:
    GameDirector(std::uint32_t domain, const std::vector<std::string>& maps);

    void start();
    void kill();
    [[nodiscard]] pid_t pid() const { return process_->pid(); }
    [[nodiscard]] bool ready() const;
    [[nodiscard]] std::string log() const { return process_->errors(); }

  private:
    TemporaryFolder folder_;
    std::unique_ptr<ChildProcess> process_;
};

}  // namespace camdir::test
