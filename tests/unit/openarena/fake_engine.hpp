// A game engine for tests: keeps cvars and configstrings, records what the module says, and calls the module
// as a server does.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

extern "C" {
void dllEntry(std::intptr_t (*)(std::intptr_t, ...));
std::intptr_t vmMain(int, int, int, int, int, int, int, int, int, int, int, int, int);
}

namespace camdir::test {

// One at a time: the module keeps its state in globals, as the engine knows only one game.
class FakeEngine {
  public:
    // With a real game module to load and nothing published.
    FakeEngine();
    ~FakeEngine();
    FakeEngine(const FakeEngine&) = delete;
    FakeEngine& operator=(const FakeEngine&) = delete;

    void start_map(const std::string& map);
    void end_map();
    // `count` frames of 50 ms.
    void run_frames(int count);
    static std::intptr_t call(int command, int a0 = 0, int a1 = 0, int a2 = 0) {
        return vmMain(command, a0, a1, a2, 0, 0, 0, 0, 0, 0, 0, 0, 0);
    }
    // A human spectator enters; clients stay over the ends of maps.
    void connect(int slot);
    void disconnect(int slot);

    [[nodiscard]] std::uint8_t* client(int slot) const;
    [[nodiscard]] std::uint8_t* entity(int number) const;

    std::map<std::string, std::string> cvars;
    std::map<std::string, std::intptr_t> cvar_flags;  // as registered
    std::map<int, std::string> configstrings;
    std::vector<std::string> prints, errors;
    std::vector<std::string> command;  // in progress: its name and arguments
    int level_time = 1000;

  private:
    static std::intptr_t answer(std::intptr_t number, ...);

    std::set<int> clients_;
    bool running_ = false;
    std::intptr_t located_[5] = {};
};

}  // namespace camdir::test
