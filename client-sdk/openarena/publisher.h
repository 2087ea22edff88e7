/* SPDX-License-Identifier: GPL-2.0-or-later */
/* The match towards the directors, on the worker: its poses, movers and events. */
#ifndef CAMERA_DIRECTOR_OPENARENA_PUBLISHER_H
#define CAMERA_DIRECTOR_OPENARENA_PUBLISHER_H

#include "frame.h"
#include "game/published_match.h"

/* All 0 = closed. */
struct publisher {
    struct published_match match;
    uint32_t last_life; /* of the poses below */
    struct player_pose last_poses[max_slots];
    /* Where the movers of a life were last; announced to the directors in an epoch. */
    uint32_t movers_life, mover_count, announced_movers;
    uint64_t movers_epoch;
    struct mover_pose movers[CDIR_MAX_MOVERS];
    uint64_t frames, events, failures; /* since the module was loaded */
};

/* Takes note of which movers have moved: of every frame, also of one that is not sent. */
void publisher_note_movers(struct publisher* publisher, const struct server_frame* frame);
/* The frame's movers, poses and events. Must be open. Returns false when that failed: cdir_last_error() says
 * why. */
bool publisher_send(struct publisher* publisher, const struct server_frame* frame);
/* Its events alone. Must be open. */
void publisher_send_events(struct publisher* publisher, const struct server_frame* frame);

#endif
