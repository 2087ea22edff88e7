/* SPDX-License-Identifier: GPL-2.0-or-later */
/*
 * The spectators' views. A human spectator is shown the director's camera, unless they chose otherwise. Which
 * player the camera shows is the director's choice, or with the game's own commands and buttons the viewer's.
 *
 * Below the camera the game goes on with the spectator as it would without this module, mostly following the
 * camera's target: its view is seen when no camera arrives. All functions are for the game's thread.
 */
#ifndef CAMERA_DIRECTOR_OPENARENA_VIEWERS_H
#define CAMERA_DIRECTOR_OPENARENA_VIEWERS_H

#include <stdbool.h>

#include "choice.h"

#ifdef __cplusplus
extern "C" {
#endif

/* First and last thing in every vmMain call, nested ones included: while the game runs, its playerStates are
 * its own. snapshots_follow: the engine may send them before its next call; only then is anything put over
 * them, because the engine calls for every command of every client. */
void viewers_suspend(void);
void viewers_resume(bool snapshots_follow);

/* Before the game's initialisation. The viewers' choices stay, as their connections do. */
void viewers_reset(void);
/* Before the game's own. first_time: not again because of a map change. */
void viewers_connect(int slot, bool first_time, bool bot);
void viewers_disconnect(int slot);
/* The game set a configstring; ignores those of no player. */
void viewers_take_configstring(int number);

/* After the game's frame: takes in what the game's own follow commands and buttons have done, and fills the
 * requests of the frame that is being sampled, which are zero before. */
void viewers_fill_requests(struct viewer_request requests[max_slots]);
/* Then: prepares what viewers_resume() shows. report: null before the first one of this life. */
void viewers_apply(const struct director_report* report, const struct frame_history* history);

/* Both return false when no human client is in the slot. profile: at most 31 bytes, "" = the server's
 * default. */
bool viewers_choose(int slot, enum viewer_choice choice);
bool viewers_choose_profile(int slot, const char* profile);
/* Before the game has such a command of the client, whether they spectate already or not. named: as
 * choice_take_command(). */
void viewers_take_follow(int slot, enum follow_command command, uint8_t named);

struct viewer_status {
    enum viewer_choice choice;
    char profile[32];   /* in effect; "" = the director's default */
    bool requests;      /* a shot */
    bool camera;        /* sees the director's camera; otherwise the game's own view */
    uint8_t target;     /* of that camera, otherwise whom the game follows; slot or no_slot */
    int32_t camera_age; /* ms since the poses of the newest camera; with `camera` */
};

/* Returns false when the slot's client is no human spectator. */
bool viewers_status(int slot, struct viewer_status* status);

/* Since the module was loaded. */
struct view_counters {
    uint64_t camera_frames; /* of all viewers */
    uint64_t cuts;          /* to and between cameras */
    uint64_t fallbacks;     /* to the game's own view because no camera arrived */
};

const struct view_counters* viewers_counters(void);

#ifdef __cplusplus
}
#endif

#endif
