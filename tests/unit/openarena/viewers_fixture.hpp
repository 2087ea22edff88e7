// A match with two bots and a spectator, and the director's camera for that one.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstdint>

#include "fake_server.hpp"

namespace camdir::openarena {

inline constexpr int viewer = 4, anna = 0, bob = 1;

class OpenArenaViewers : public testing::Test {
  protected:
    OpenArenaViewers() {
        game.connect_bot(anna, "Anna");
        game.connect_bot(bob, "Bob");
        game.connect_spectator(viewer, "Eve");
        for (int i = 0; i < 3; ++i)
            game.run_frame();
    }

    // Frames with a camera that is one frame late, as live.
    void watch(int target, std::uint32_t segment, int frames = 1) {
        for (int i = 0; i < frames; ++i) {
            game.set_camera(viewer, target, segment, x += 5);
            game.run_frame();
        }
    }
    std::array<float, 3> shown_position() {
        std::array<float, 3> result = vector(PS_ORIGIN);
        result[2] += static_cast<float>(read_int(game.state(viewer), PS_VIEW_HEIGHT));
        return result;
    }
    std::array<float, 3> vector(std::size_t offset) {
        std::array<float, 3> result;
        read_vector(result.data(), game.state(viewer), offset);
        return result;
    }
    bool follows(int target) {
        const State own = game.own(viewer);
        return (read_int(own.data(), PS_PM_FLAGS) & PM_FLAG_FOLLOW) != 0 &&
               read_int(own.data(), PS_CLIENT_NUMBER) == target;
    }
    bool flies_freely() {
        return !game.shows_camera(viewer) && read_int(game.state(viewer), PS_PM_TYPE) == PM_SPECTATOR &&
               read_int(game.state(viewer), PS_PM_FLAGS) == 0;
    }

    FakeServer game;
    float x = 0;
};

// A client blends two snapshots in a row of one client number and teleport bit.
inline bool blends(const State& before, const State& after) {
    const int changed = read_int(before.data(), PS_EFLAGS) ^ read_int(after.data(), PS_EFLAGS);
    return (changed & EFLAG_TELEPORT) == 0 &&
           read_int(before.data(), PS_CLIENT_NUMBER) == read_int(after.data(), PS_CLIENT_NUMBER);
}

}  // namespace camdir::openarena
