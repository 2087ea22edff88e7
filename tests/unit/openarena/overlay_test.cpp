#include "overlay.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <array>

namespace camdir::openarena {
namespace {

using State = std::array<std::uint8_t, player_state_size>;

constexpr int slot = 7;
constexpr view somewhere = {{1, 2, 3}, {10, 20, 30}};

State any_state() {
    State state;
    for (std::uint8_t& byte : state)
        byte = *rc::gen::arbitrary<std::uint8_t>();
    return state;
}

State spectator(int number, int teleport_bit) {
    State state{};
    write_int(state.data(), PS_PM_TYPE, PM_SPECTATOR);
    write_int(state.data(), PS_CLIENT_NUMBER, number);
    write_int(state.data(), PS_EFLAGS, teleport_bit | 0x10);
    return state;
}

int bit_of(const State& state) {
    return read_int(state.data(), PS_EFLAGS) & EFLAG_TELEPORT;
}

State put_on(overlay& shown, State state) {
    overlay_put_on(&shown, state.data());
    shown.on = false;
    return state;
}

TEST(OpenArenaOverlay, TakingOffRestoresEveryByteExceptThePing) {
    rc::check([] {
        State state = any_state();
        const int type =
            *rc::gen::element(int{PM_NORMAL}, int{PM_SPECTATOR}, int{PM_DEAD}, int{PM_INTERMISSION});
        write_int(state.data(), PS_PM_TYPE, type);
        const State before = state;
        overlay shown{};
        overlay_show_camera(&shown, slot, 1000, &somewhere, false);
        if (*rc::gen::arbitrary<bool>()) overlay_show_own(&shown, slot, state.data());
        overlay_put_on(&shown, state.data());
        RC_ASSERT(read_int(state.data(), PS_PING) == read_int(before.data(), PS_PING));
        const int ping = *rc::gen::inRange(0, 999);
        write_int(state.data(), PS_PING, ping);
        State expected = before;
        write_int(expected.data(), PS_PING, ping);
        overlay_take_off(&shown, state.data());
        RC_ASSERT(state == expected);
    });
}

TEST(OpenArenaOverlay, ShowsTheView) {
    overlay shown{};
    overlay_show_camera(&shown, slot, 1234, &somewhere, false);
    State state = spectator(slot, 0);
    write_int(state.data(), PS_PING, 48);
    state = put_on(shown, state);
    State expected{};
    const auto set = [&](std::size_t offset, int value) { write_int(expected.data(), offset, value); };
    set(0, 1234);
    set(4, 2);
    set(12, 4096);
    const float below_the_eye[3] = {1, 2, 3 - 26};
    write_vector(expected.data(), 20, below_the_eye);
    set(68, 1023);
    set(104, 4);
    set(140, slot);
    write_vector(expected.data(), 152, somewhere.angles);
    set(164, 26);
    set(184, 100);
    set(212, 100);
    set(260, 3);
    set(264, 1);
    set(452, 48);
    EXPECT_EQ(state, expected);
}

TEST(OpenArenaOverlay, LeavesPlayersAndIntermissionsAlone) {
    for (const int type : {PM_NORMAL, PM_DEAD, PM_INTERMISSION}) {
        overlay shown{};
        overlay_show_camera(&shown, slot, 1000, &somewhere, false);
        State state = spectator(slot, 0);
        write_int(state.data(), PS_PM_TYPE, type);
        const State before = state;
        overlay_put_on(&shown, state.data());
        EXPECT_EQ(state, before) << "pm_type " << type;
    }
}

TEST(OpenArenaOverlay, TheTeleportBitTogglesAtCutsOnly) {
    rc::check([] {
        overlay shown{};
        State own = spectator(slot, *rc::gen::element(0, int{EFLAG_TELEPORT}));
        overlay_show_own(&shown, slot, own.data());
        int bit = bit_of(put_on(shown, own)), time = 1000;
        bool camera = false;
        for (const int event : *rc::gen::container<std::vector<int>>(rc::gen::inRange(0, 8))) {
            // 0: the game's own view, 1: a cut, else the camera goes on.
            const bool cut = event <= 1 ? camera || event == 1 : !camera;
            if (event == 0) {
                overlay_show_own(&shown, slot, own.data());
            } else {
                overlay_show_camera(&shown, slot, time, &somewhere, event == 1);
            }
            const int next = bit_of(put_on(shown, own));
            RC_ASSERT((next != bit) == cut);
            bit = next;
            camera = event != 0;
            time += 10;
        }
    });
}

TEST(OpenArenaOverlay, ACutToFreeFlightChangesNothingElse) {
    for (const int own_bit : {0, int{EFLAG_TELEPORT}}) {
        for (const bool second_cut : {false, true}) {
            overlay shown{};
            State own = spectator(slot, own_bit);
            overlay_show_own(&shown, slot, own.data());
            overlay_show_camera(&shown, slot, 950, &somewhere, false);
            if (second_cut) overlay_show_camera(&shown, slot, 1000, &somewhere, true);
            State expected = own;
            write_int(expected.data(), PS_EFLAGS, (shown.teleport_bit ^ EFLAG_TELEPORT) | 0x10);
            overlay_show_own(&shown, slot, own.data());
            EXPECT_EQ(own, expected);
            overlay_show_own(&shown, slot, own.data());
            EXPECT_EQ(own, expected) << "for good";
            EXPECT_EQ(put_on(shown, own), own);
        }
    }
}

TEST(OpenArenaOverlay, AFollowedPlayersViewNeedsNoDeclaration) {
    overlay shown{};
    overlay_show_camera(&shown, slot, 1000, &somewhere, false);
    State own = spectator(3, EFLAG_TELEPORT);
    const State before = own;
    overlay_show_own(&shown, slot, own.data());
    EXPECT_EQ(own, before);
    EXPECT_EQ(put_on(shown, own), before);
}

TEST(OpenArenaOverlay, ASpawnTogglesWhatTheClientWasShown) {
    for (const int own_bit : {0, int{EFLAG_TELEPORT}}) {
        overlay shown{};
        State own = spectator(slot, own_bit);
        State expected = own;
        overlay_prepare_spawn(&shown, own.data());
        EXPECT_EQ(own, expected) << "the game's own view is shown";
        overlay_show_camera(&shown, slot, 1000, &somewhere, true);
        overlay_prepare_spawn(&shown, own.data());
        write_int(expected.data(), PS_EFLAGS, shown.teleport_bit | 0x10);
        EXPECT_EQ(own, expected);
    }
}

}  // namespace
}  // namespace camdir::openarena
