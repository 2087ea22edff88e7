#include "fake_engine.hpp"

#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <numeric>
#include <stdexcept>

#include "engine.h"

namespace camdir::test {

namespace {

FakeEngine* running_engine = nullptr;

std::string text_at(std::intptr_t address) {
    return address == 0 ? "" : reinterpret_cast<const char*>(address);
}

void store(std::intptr_t address, std::intptr_t size, const std::string& text) {
    std::snprintf(reinterpret_cast<char*>(address), static_cast<std::size_t>(size), "%s", text.c_str());
}

}  // namespace

FakeEngine::FakeEngine() {
    cvars = {{"director_game", FAKE_GAME}, {"director_enable", "0"}, {"sv_fps", "20"}, {"net_port", "27960"}};
    running_engine = this;
}

FakeEngine::~FakeEngine() {
    if (running_) end_map();
    running_engine = nullptr;
}

void FakeEngine::start_map(const std::string& map) {
    if (running_) end_map();
    cvars["mapname"] = map;
    dllEntry(&FakeEngine::answer);
    running_ = true;
    call(GAME_INIT, level_time);
    for (const int slot : clients_)
        call(GAME_CLIENT_CONNECT, slot, 0, 0);
}

void FakeEngine::end_map() {
    call(GAME_SHUTDOWN);
    running_ = false;
}

void FakeEngine::connect(int slot) {
    clients_.insert(slot);
    call(GAME_CLIENT_CONNECT, slot, 1, 0);
}

void FakeEngine::disconnect(int slot) {
    clients_.erase(slot);
    call(GAME_CLIENT_DISCONNECT, slot);
}

void FakeEngine::run_frames(int count) {
    for (int i = 0; i < count; ++i) {
        level_time += 50;
        call(GAME_RUN_FRAME, level_time);
    }
}

std::uint8_t* FakeEngine::entity(int number) const {
    return reinterpret_cast<std::uint8_t*>(located_[0]) + number * located_[2];
}

std::uint8_t* FakeEngine::client(int slot) const {
    return reinterpret_cast<std::uint8_t*>(located_[3]) + slot * located_[4];
}

// Reads more arguments than most calls have, as engines do.
__attribute__((no_sanitize("address"))) std::intptr_t FakeEngine::answer(std::intptr_t number, ...) {
    FakeEngine& engine = *running_engine;
    std::intptr_t a[engine_call_arguments];
    std::va_list arguments;
    va_start(arguments, number);
    for (std::intptr_t& argument : a) {
        argument = va_arg(arguments, std::intptr_t);
    }
    va_end(arguments);
    const auto word = [&](std::intptr_t index) {
        return index >= 0 && index < std::ssize(engine.command)
                   ? engine.command[static_cast<std::size_t>(index)]
                   : std::string();
    };
    enum { drop_client = 16, call_with_all = 700 };
    switch (number) {
        case ENGINE_PRINT:
            engine.prints.push_back(text_at(a[0]));
            break;
        case ENGINE_ERROR:
            engine.errors.push_back(text_at(a[0]));
            break;
        case ENGINE_CVAR_REGISTER:
            engine.cvars.emplace(text_at(a[1]), text_at(a[2]));
            engine.cvar_flags[text_at(a[1])] = a[3];
            break;
        case ENGINE_CVAR_SET:
            engine.cvars[text_at(a[0])] = text_at(a[1]);
            break;
        case ENGINE_CVAR_INTEGER:
            return std::atoi(engine.cvars[text_at(a[0])].c_str());
        case ENGINE_CVAR_STRING:
            store(a[1], a[2], engine.cvars[text_at(a[0])]);
            break;
        case ENGINE_ARGC:
            return std::ssize(engine.command);
        case ENGINE_ARGV:
            store(a[1], a[2], word(a[0]));
            break;
        case ENGINE_LOCATE_GAME_DATA:
            std::copy(a, a + 5, engine.located_);
            break;
        case drop_client:
            call(GAME_CLIENT_DISCONNECT, static_cast<int>(a[0]));
            break;
        case ENGINE_SET_CONFIGSTRING:
            engine.configstrings[static_cast<int>(a[0])] = text_at(a[1]);
            break;
        case ENGINE_GET_CONFIGSTRING:
            store(a[1], a[2], engine.configstrings[static_cast<int>(a[0])]);
            break;
        case call_with_all:
            return std::accumulate(std::begin(a), std::end(a), std::intptr_t{0},
                                   [](std::intptr_t sum, std::intptr_t each) { return 16 * sum + each; });
        default:
            break;
    }
    return 0;
}

}  // namespace camdir::test
