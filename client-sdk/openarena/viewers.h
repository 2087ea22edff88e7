/* SPDX-License-Identifier: GPL-2.0-or-later */
/* The spectators' views. */
#ifndef CAMERA_DIRECTOR_OPENARENA_VIEWERS_H
#define CAMERA_DIRECTOR_OPENARENA_VIEWERS_H

#include "frame.h"

/* Before the game's initialisation. */
void viewers_reset(void);
/* First thing in every call of the engine: gives the game its own playerStates back. */
void viewers_restore(void);
void viewers_disconnect(int slot);
/* Fills the requests of the frame that is being sampled. */
void viewers_fill_requests(struct viewer_request requests[max_slots]);
/* Last thing after the game's frame. report: null before the first one of this life. */
void viewers_apply(const struct director_report* report, const struct frame_history* history);

#endif
