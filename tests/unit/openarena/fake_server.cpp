#include "fake_server.hpp"

#include <gtest/gtest.h>

#include <strings.h>

#include <algorithm>
#include <cctype>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "game.h"
#include "roster.h"

namespace camdir::openarena {
namespace {

FakeServer* current = nullptr;

// As the engine's, it takes more arguments than most calls have.
__attribute__((no_sanitize("address"))) std::intptr_t call_engine(std::intptr_t number, ...) {
    std::array<std::intptr_t, engine_call_arguments> arguments{};
    va_list list;
    va_start(list, number);
    for (std::intptr_t& argument : arguments)
        argument = va_arg(list, std::intptr_t);
    va_end(list);
    return current->answer(number, arguments.data());
}

void copy(std::intptr_t to, std::intptr_t size, const std::string& text) {
    std::snprintf(reinterpret_cast<char*>(to), static_cast<std::size_t>(size), "%s", text.c_str());
}

}  // namespace

FakeServer::FakeServer()
    : clients_(max_slots * client_size),
      entities_(max_slots * static_cast<std::size_t>(entity_shared_size)),
      configstrings_(1024) {
    current = this;
    options.match.enabled = options.spectate = 1;
    engine_attach(call_engine);
    restart(false);
}

FakeServer::~FakeServer() {
    for (int slot = 0; slot < max_slots; ++slot)
        viewers_disconnect(slot);
    engine_forget_game_data();
    current = nullptr;
}

void FakeServer::restart(bool same_map) {
    viewers_suspend();
    viewers_reset();
    if (!same_map) level_time = 1000;
    intermission_ = false;
    history_ = {};
    report = {};
    report.life = 1;
    std::fill(clients_.begin(), clients_.end(), std::uint8_t{0});
    const std::array<std::intptr_t, engine_call_arguments> data = {
        reinterpret_cast<std::intptr_t>(entities_.data()), max_slots, entity_shared_size,
        reinterpret_cast<std::intptr_t>(clients_.data()), static_cast<std::intptr_t>(client_size)};
    engine_locate(data.data());
    for (int slot = 0; slot < max_slots; ++slot) {
        const Client& client = game_[static_cast<std::size_t>(slot)];
        if (!client.connected) continue;
        if (!client.bot) viewers_connect(slot, false, false);
        spawn(slot);
    }
    viewers_resume(false);
}

void FakeServer::set_configstring(int slot, const std::string& name, int team) {
    const int number = CONFIGSTRING_PLAYERS + slot;
    configstrings_[static_cast<std::size_t>(number)] =
        name.empty() ? "" : "n\\" + name + "\\t\\" + std::to_string(team) + "\\model\\sarge";
    roster_take_configstring(number, configstring(number).c_str());
    viewers_take_configstring(number);
}

void FakeServer::spawn(int slot) {
    std::uint8_t* const state = this->state(slot);
    const Client& client = game_[static_cast<std::size_t>(slot)];
    const float place[3] = {100.0F * static_cast<float>(slot), 0, 0};
    write_int(state, PS_EFLAGS, (read_int(state, PS_EFLAGS) & EFLAG_TELEPORT) ^ EFLAG_TELEPORT);
    write_int(state, PS_PM_TYPE, client.spectates ? PM_SPECTATOR : PM_NORMAL);
    write_int(state, PS_PM_FLAGS, 0);
    write_int(state, PS_CLIENT_NUMBER, slot);
    write_int(state, PS_STATS, 100);
    write_int(state, PS_VIEW_HEIGHT, 26);
    write_int(state, PS_PERSISTANT + 4 * PERSISTANT_SPAWN_COUNT, 1);
    write_vector(state, PS_ORIGIN, place);
}

void FakeServer::connect_spectator(int slot, const std::string& name, bool first_time) {
    call([&] {
        viewers_connect(slot, first_time, false);
        game_[static_cast<std::size_t>(slot)] = {true, true, false, -1};
        std::fill_n(state(slot), client_size, std::uint8_t{0});
        set_configstring(slot, name, team_spectator);
        spawn(slot);
    });
}

void FakeServer::connect_bot(int slot, const std::string& name) {
    call([&] {
        game_[static_cast<std::size_t>(slot)] = {true, false, true, -1};
        std::fill_n(state(slot), client_size, std::uint8_t{0});
        set_configstring(slot, name, team_free);
        spawn(slot);
    });
}

void FakeServer::disconnect(int slot) {
    call(
        [&] {
            if (!game_[static_cast<std::size_t>(slot)].bot) viewers_disconnect(slot);
            game_[static_cast<std::size_t>(slot)] = {};
            set_configstring(slot, "", 0);
        },
        true);
}

void FakeServer::join_team(int slot, int team) {
    call([&] {
        game_[static_cast<std::size_t>(slot)].spectates = team == team_spectator;
        game_[static_cast<std::size_t>(slot)].followed = -1;
        set_configstring(slot, roster_at(slot)->name, team);
        spawn(slot);
    });
}

void FakeServer::change_name(int slot, const std::string& name) {
    call([&] { set_configstring(slot, name, roster_at(slot)->team); });
}

void FakeServer::follow(int slot, int target) {
    game_[static_cast<std::size_t>(slot)].followed = target;
}

void FakeServer::stop_following(int slot) {
    game_[static_cast<std::size_t>(slot)].followed = -1;
    write_int(state(slot), PS_PM_FLAGS, 0);
    write_int(state(slot), PS_PM_TYPE, PM_SPECTATOR);
    write_int(state(slot), PS_CLIENT_NUMBER, slot);
}

void FakeServer::kill(int slot) {
    call([&] {
        write_int(state(slot), PS_PM_TYPE, PM_DEAD);
        write_int(state(slot), PS_STATS, 0);
        write_int(state(slot), PS_VIEW_HEIGHT, -16);
    });
}

void FakeServer::respawn(int slot) {
    call([&] { spawn(slot); });
}

bool FakeServer::can_be_followed(int slot) const {
    return slot >= 0 && slot < max_slots && game_[static_cast<std::size_t>(slot)].connected &&
           !game_[static_cast<std::size_t>(slot)].spectates;
}

void FakeServer::begin_intermission() {
    intermission_ = true;
}

void FakeServer::end_frame() {
    for (int slot = 0; slot < max_slots; ++slot) {
        Client& client = game_[static_cast<std::size_t>(slot)];
        if (!client.connected) continue;
        if (intermission_) {
            stop_following(slot);
            write_int(state(slot), PS_PM_TYPE, PM_INTERMISSION);
        } else if (client.followed >= 0 && !can_be_followed(client.followed)) {
            client.followed = -1;
            spawn(slot);
        } else if (client.followed >= 0) {
            const std::int32_t ping = read_int(state(slot), PS_PING);
            std::copy_n(state(client.followed), player_state_size, state(slot));
            write_int(state(slot), PS_PM_FLAGS, read_int(state(slot), PS_PM_FLAGS) | PM_FLAG_FOLLOW);
            write_int(state(slot), PS_PING, ping);
        }
    }
}

void FakeServer::run_frame(int ms) {
    level_time += ms;
    call(
        [&] {
            end_frame();
            if (in_frame_) std::exchange(in_frame_, nullptr)();
            server_frame& frame = history_.frames[history_.count % history_length];
            frame = {};
            frame.life = 1;
            frame.level_time = level_time;
            for (int slot = 0; slot < max_slots; ++slot) {
                const Client& client = game_[static_cast<std::size_t>(slot)];
                player_pose& player = frame.players[slot];
                if (!client.connected) continue;
                player.in_game = 1;
                player.bot = client.bot;
                player.spectator = client.spectates;
                player.alive = !client.spectates && read_int(state(slot), PS_STATS) > 0;
                player.teleport_bit = (read_int(state(slot), PS_EFLAGS) & EFLAG_TELEPORT) != 0;
                player.viewheight = static_cast<std::int16_t>(read_int(state(slot), PS_VIEW_HEIGHT));
                read_vector(player.origin, state(slot), PS_ORIGIN);
            }
            viewers_fill_requests(frame.viewers);
            ++history_.count;
            viewers_apply(has_report ? &report : nullptr, &history_);
            for (int slot = 0; slot < max_slots; ++slot)
                own_[static_cast<std::size_t>(slot)] = snapshot(slot);
        },
        true);
    for (int slot = 0; slot < max_slots; ++slot)
        sent_states_[static_cast<std::size_t>(slot)] = snapshot(slot);
}

void FakeServer::call(const std::function<void()>& game, bool snapshots_follow) {
    viewers_suspend();
    game();
    viewers_resume(snapshots_follow);
}

bool FakeServer::client_command(int slot, std::vector<std::string> words) {
    words_ = std::move(words);
    bool taken = false;
    call([&] {
        taken = commands_client(slot);
        if (!taken) execute(slot, words_);
    });
    return taken;
}

bool FakeServer::console_command(std::vector<std::string> words) {
    words_ = std::move(words);
    bool taken = false;
    call([&] { taken = commands_console(); });
    return taken;
}

void FakeServer::execute(int slot, const std::vector<std::string>& words) {
    const Client& client = game_[static_cast<std::size_t>(slot)];
    const bool follow_command = strcasecmp(words.at(0).c_str(), "follow") == 0;
    if (intermission_) return;
    if (words[0] == "team") {
        join_team(slot, words.at(1) == "s" ? team_spectator : team_free);
    } else if (follow_command && words.size() != 2) {
        if (client.followed >= 0) stop_following(slot);
    } else if (follow_command || words[0] == "follownext") {
        int target = std::max(client.followed, 0);
        if (follow_command) {
            target = player_named(words[1]);
        } else {
            for (int i = 0; i < max_slots && (i == 0 || !can_be_followed(target)); ++i)
                target = (target + 1) % max_slots;
        }
        if (target == slot || !can_be_followed(target)) return;
        if (!client.spectates) join_team(slot, team_spectator);
        follow(slot, target);
    }
}

int FakeServer::player_named(const std::string& text) const {
    if (std::isdigit(static_cast<unsigned char>(text.c_str()[0])) != 0) return std::atoi(text.c_str());
    for (int slot = 0; slot < max_slots; ++slot) {
        if (roster_at(slot)->in_use && strcasecmp(text.c_str(), roster_at(slot)->name) == 0) return slot;
    }
    return -1;
}

State FakeServer::snapshot(int slot) {
    State result;
    std::copy_n(state(slot), player_state_size, result.begin());
    return result;
}

bool FakeServer::shows_camera(int slot) {
    viewer_status status{};
    return viewers_status(slot, &status) && status.camera &&
           read_int(state(slot), PS_PM_FLAGS) == PM_FLAG_FOLLOW &&
           read_int(state(slot), PS_CLIENT_NUMBER) == slot && read_int(state(slot), PS_VIEW_HEIGHT) == 26;
}

viewer_request FakeServer::request(int slot) const {
    return frame_before(&history_, 0)->viewers[slot];
}

std::vector<std::string> FakeServer::sent_to(int slot) const {
    std::vector<std::string> result;
    for (const auto& [to, text] : sent_) {
        if (to == slot) result.push_back(text);
    }
    return result;
}

void FakeServer::set_camera(int slot, int target, std::uint32_t segment, float x) {
    viewer_camera& camera = report.cameras[slot];
    camera = {};
    camera.live = 1;
    camera.target = static_cast<std::uint8_t>(target);
    camera.segment = segment;
    camera.level_time = level_time;
    camera.position[0] = x;
    camera.position[2] = 50;
    camera.orientation[3] = 1;
    camera.clearance = 100;
    camera.vertical_fov = 1;
}

std::intptr_t FakeServer::answer(std::intptr_t number, const std::intptr_t* arguments) {
    switch (number) {
        case ENGINE_PRINT:
            printed += reinterpret_cast<const char*>(arguments[0]);
            return 0;
        case ENGINE_ARGC:
            return static_cast<std::intptr_t>(words_.size());
        case ENGINE_ARGV: {
            const auto index = static_cast<std::size_t>(arguments[0]);
            copy(arguments[1], arguments[2], index < words_.size() ? words_[index] : "");
            return 0;
        }
        case ENGINE_SEND_SERVER_COMMAND:
            sent_.emplace_back(static_cast<int>(arguments[0]), reinterpret_cast<const char*>(arguments[1]));
            return 0;
        case ENGINE_GET_CONFIGSTRING:
            copy(arguments[1], arguments[2], configstrings_.at(static_cast<std::size_t>(arguments[0])));
            return 0;
        case ENGINE_GET_USER_COMMAND:
            std::memcpy(reinterpret_cast<std::uint8_t*>(arguments[1]) + 4,
                        user_angles[static_cast<std::size_t>(arguments[0])].data(), 12);
            return 0;
        default:
            ADD_FAILURE() << "unexpected call " << number << " of the engine";
            return 0;
    }
}

}  // namespace camdir::openarena

// What the module's other parts offer to the tested ones.
extern "C" {
void game_client_command(int slot, const char* const* words, int count) {
    camdir::openarena::current->execute(slot, {words, words + count});
}

const struct settings* module_settings(void) {
    return &camdir::openarena::current->options;
}

const struct director_report* module_report(void) {
    return camdir::openarena::current->has_report ? &camdir::openarena::current->report : nullptr;
}

const struct proxy_counters* module_counters(void) {
    static const struct proxy_counters counters = {};
    return &counters;
}

const char* module_map(void) {
    return "oa_dm1";
}

uint32_t module_life(void) {
    return 1;
}
}
