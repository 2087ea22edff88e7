/* SPDX-License-Identifier: GPL-2.0-or-later */
#include "choice.h"

#include <string.h>

struct choice choice_of_newcomer(void) {
    struct choice choice;
    memset(&choice, 0, sizeof choice);
    choice.player = choice.followed = choice.shown = choice.expected = choice.named = no_slot;
    return choice;
}

void choice_set(struct choice* choice, enum viewer_choice what) {
    choice->what = what;
    choice->player = no_slot;
    choice->command = follow_nothing;
    choice->by_director = true;
}

void choice_take_command(struct choice* choice, enum follow_command command, uint8_t named) {
    choice->command = command;
    choice->named = named;
}

void choice_take_departure(struct choice* choice, uint8_t player) {
    if (player == choice->followed || player == choice->expected || player == choice->player)
        choice->player_left = true;
}

void choice_expect(struct choice* choice, uint8_t followed) {
    choice->expected = followed;
}

static uint8_t whom_game_follows(const struct choice* choice, uint8_t shown,
                                 uint8_t (*passed_on)(uint8_t slot)) {
    const uint8_t candidates[] = {choice->followed, choice->expected};
    for (size_t i = 0; i < sizeof candidates; ++i) {
        if (candidates[i] != no_slot && shown != no_slot && passed_on(candidates[i]) == shown)
            return candidates[i];
    }
    /* The game may have copied the state before it changed in this frame. */
    return shown == choice->shown ? choice->followed : shown;
}

static bool is_viewers(const struct choice* choice, uint8_t followed) {
    if (choice->command == follow_stop) return true;
    if (choice->command == follow_next && followed != no_slot) return true;
    if (choice->command == follow_player && followed != no_slot && followed == choice->named) return true;
    if (choice->by_director || followed == choice->followed || followed == choice->expected) return false;
    return followed != no_slot || !choice->player_left;
}

static void end_frame(struct choice* choice) {
    choice->command = follow_nothing;
    choice->by_director = choice->player_left = false;
}

void choice_take_frame(struct choice* choice, uint8_t shown, uint8_t (*passed_on)(uint8_t slot)) {
    const uint8_t followed = whom_game_follows(choice, shown, passed_on);
    if (is_viewers(choice, followed)) {
        if (choice->what == choice_auto) choice->what = choice_follow;
        choice->player = followed;
    } else if (choice->player_left && followed == no_slot) {
        choice->player = no_slot;
    }
    choice->followed = choice->expected = followed;
    choice->shown = shown;
    end_frame(choice);
}

void choice_begin(struct choice* choice, uint8_t shown, uint8_t (*passed_on)(uint8_t slot)) {
    /* The player may not be back yet. */
    if (shown == no_slot) choice->followed = no_slot;
    choice->expected = choice->followed;
    choice_take_frame(choice, shown, passed_on);
}

void choice_skip_frame(struct choice* choice) {
    choice->followed = choice->shown = choice->expected = no_slot;
    end_frame(choice);
}
