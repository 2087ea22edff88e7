// A client of QuakeWorld that only spectates, and gives the server commands: KTX adds bots for clients alone.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <thread>

namespace camdir::test {

// Joins the server at this port of this machine, adds bots one by one, and stays until the destructor.
class QuakeWorldSpectator {
  public:
    QuakeWorldSpectator(int port, int bots);
    ~QuakeWorldSpectator();
    QuakeWorldSpectator(const QuakeWorldSpectator&) = delete;
    QuakeWorldSpectator& operator=(const QuakeWorldSpectator&) = delete;

  private:
    // What the server has been told; each once a packet of the server shows that it has taken the one before.
    enum class Step { greet, spawn, begin, add_bots };

    void run(const std::stop_token& stop);
    [[nodiscard]] bool connect(const std::stop_token& stop);
    void take(std::string_view packet);
    void take_step();
    // One packet with a command, or none.
    void send(const std::string& command = {});

    int socket_;
    int bots_;
    Step step_ = Step::greet;
    std::uint32_t sent_ = 0;
    std::uint32_t received_ = 0;
    bool odd_ = false;   // an odd number of reliable packets has been received
    std::string level_;  // the server's number of it
    std::jthread thread_;
};

}  // namespace camdir::test
