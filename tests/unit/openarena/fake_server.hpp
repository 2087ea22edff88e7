// An engine and a game for the module's parts: clients that spectate, follow and fly, without a server. One
// at a time, because the parts keep their state in their files.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "commands.h"
#include "engine.h"
#include "proxy.h"
#include "viewers.h"

namespace camdir::openarena {

using State = std::array<std::uint8_t, player_state_size>;

class FakeServer {
  public:
    FakeServer();
    ~FakeServer();

    // Clients. A bot is not announced to the module, as in the real game.
    void connect_spectator(int slot, const std::string& name, bool first_time = true);
    void connect_bot(int slot, const std::string& name);
    void disconnect(int slot);
    void join_team(int slot, int team);
    void change_name(int slot, const std::string& name);
    // What the game does at the end of its next frame, after it has updated everybody's state.
    void in_next_frame(std::function<void()> what) { in_frame_ = std::move(what); }
    // What attack and the follow commands do in the end.
    void follow(int slot, int target);
    void stop_following(int slot);
    void kill(int slot);
    void respawn(int slot);
    void begin_intermission();
    void restart(bool same_map);

    // One server frame of `ms`: the game's, then the module's. The director's cameras are those in `report`.
    void run_frame(int ms = 50);
    // A vmMain call that runs `game` as the game. snapshots_follow: the engine may send some before the next.
    void call(const std::function<void()>& game, bool snapshots_follow = false);
    // A client's or the console's command; returns whether the module took it.
    bool client_command(int slot, std::vector<std::string> words);
    bool console_command(std::vector<std::string> words);

    // As the engine sees it, and as the game saw it at the end of its last frame.
    std::uint8_t* state(int slot) { return clients_.data() + static_cast<std::size_t>(slot) * client_size; }
    State snapshot(int slot);
    State own(int slot) const { return own_[static_cast<std::size_t>(slot)]; }
    bool shows_camera(int slot);
    // As the engine sent it after its last frame.
    State sent(int slot) const { return sent_states_[static_cast<std::size_t>(slot)]; }
    int teleport_bit(int slot) { return read_int(state(slot), PS_EFLAGS) & EFLAG_TELEPORT; }
    viewer_request request(int slot) const;
    std::vector<std::string> sent_to(int slot) const;
    void forget_sent() { sent_.clear(); }
    std::string configstring(int number) const { return configstrings_[static_cast<std::size_t>(number)]; }

    // A live camera of the newest frame, `x` along the x axis.
    void set_camera(int slot, int target, std::uint32_t segment, float x);

    int level_time = 1000;
    settings options{};
    director_report report{};
    bool has_report = true;
    std::string printed;
    std::array<std::array<std::int32_t, 3>, max_slots> user_angles{};

    // The interface of the module's C parts.
    std::intptr_t answer(std::intptr_t number, const std::intptr_t* arguments);
    void execute(int slot, const std::vector<std::string>& words);

    static constexpr std::size_t client_size = player_state_size + 100;

  private:
    struct Client {
        bool connected = false, spectates = false, bot = false;
        int followed = -1;
    };
    void set_configstring(int slot, const std::string& name, int team);
    void spawn(int slot);
    bool can_be_followed(int slot) const;
    int player_named(const std::string& text) const;
    void end_frame();

    std::vector<std::uint8_t> clients_, entities_;
    std::array<Client, max_slots> game_{};
    std::vector<std::string> configstrings_, words_;
    std::vector<std::pair<int, std::string>> sent_;
    std::array<State, max_slots> own_{}, sent_states_{};
    frame_history history_{};
    bool intermission_ = false;
    std::function<void()> in_frame_;
};

}  // namespace camdir::openarena
