/* SPDX-License-Identifier: GPL-2.0-or-later */
/*
 * What one viewer chose: by the director's commands, by the game's own commands, or by buttons, which show
 * only in whom the game follows. The last choice holds, whatever this module has the game follow meanwhile.
 */
#ifndef CAMERA_DIRECTOR_OPENARENA_CHOICE_H
#define CAMERA_DIRECTOR_OPENARENA_CHOICE_H

#include <stdbool.h>

#include "frame.h"

#ifdef __cplusplus
extern "C" {
#endif

enum viewer_choice {
    choice_auto,   /* the director chooses the player */
    choice_follow, /* the viewer does; whoever stops following flies freely, without the director */
    choice_off     /* the game's own spectating */
};

/* The game's own commands. */
enum follow_command {
    follow_nothing,
    follow_stop,  /* `follow` */
    follow_next,  /* `follownext`, `followprev` */
    follow_player /* `follow NAME` */
};

struct choice {
    enum viewer_choice what;
    uint8_t player;   /* whom the viewer follows by their own choice: slot or no_slot */
    uint8_t followed; /* slot that the game follows for the viewer in the newest frame, or no_slot */

    uint8_t shown;    /* the same, as the viewer's playerState has it */
    uint8_t expected; /* whom the game follows next, as far as this module knows */
    /* Since the newest frame: */
    enum follow_command command;
    uint8_t named;    /* by follow_player: slot or no_slot */
    bool by_director; /* a command of the director came: changes from before it do not count */
    bool player_left; /* one of the above */
};

/* Of a client that has just connected. */
struct choice choice_of_newcomer(void);
void choice_set(struct choice* choice, enum viewer_choice what);
/* named: the slot that the command names, or no_slot. The game may refuse it. */
void choice_take_command(struct choice* choice, enum follow_command command, uint8_t named);
/* A player cannot be followed any more. */
void choice_take_departure(struct choice* choice, uint8_t player);
/* This module had the game follow a player, or nobody. */
void choice_expect(struct choice* choice, uint8_t followed);

/* After each of the game's frames. shown: the slot whose state the viewer's is a copy of, or no_slot.
 * passed_on: the same of a player whom the game may follow; an eliminated player watches another. */
void choice_take_frame(struct choice* choice, uint8_t shown, uint8_t (*passed_on)(uint8_t slot));
/* The same for the first frame as a spectator. The game follows on whom it followed before a restart. */
void choice_begin(struct choice* choice, uint8_t shown, uint8_t (*passed_on)(uint8_t slot));
/* For a frame that tells nothing: no spectator, or the intermission, in which the game follows nobody. */
void choice_skip_frame(struct choice* choice);

#ifdef __cplusplus
}
#endif

#endif
