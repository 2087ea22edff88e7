/* SPDX-License-Identifier: GPL-2.0-or-later */
/* The spectators' views. */
#ifndef CAMERA_DIRECTOR_OPENARENA_VIEWERS_H
#define CAMERA_DIRECTOR_OPENARENA_VIEWERS_H

#include <stdbool.h>

#include "frame.h"

/* Before the game's initialisation. */
void viewers_reset(void);
/* First and last thing in every call of the engine, which may be nested: between them the game and all other
 * parts see the game's own playerStates. */
void viewers_suspend(void);
void viewers_resume(void);
/* Before the game's own GAME_CLIENT_CONNECT, after its GAME_CLIENT_DISCONNECT. */
void viewers_connect(int slot, bool first_time);
void viewers_disconnect(int slot);
/* When the game sets a configstring. */
void viewers_take_configstring(int number);
/* Fills the requests of the frame that is being sampled. */
void viewers_fill_requests(struct viewer_request requests[max_slots]);
/* After the game's frame. report: null before the first one of this life. */
void viewers_apply(const struct director_report* report, const struct frame_history* history);

#endif
