/* SPDX-License-Identifier: GPL-2.0-or-later */
/* The match towards the directors, on the worker: its description, poses and events. */
#ifndef CAMERA_DIRECTOR_OPENARENA_PUBLISHER_H
#define CAMERA_DIRECTOR_OPENARENA_PUBLISHER_H

#include "exchange.h"
#include "game/published_match.h"

/* All 0 = closed. */
struct publisher {
    struct published_match match;
    uint32_t last_life; /* of the poses below */
    struct player_pose last_poses[max_slots];
    uint64_t frames, events, failures; /* since the module was loaded */
};

/* As published_match_announce(). */
bool publisher_announce(struct publisher* publisher, const struct match_state* state);
/* The frame's poses and events. Must be open. Returns false when that failed: it is closed then, and
 * cdir_last_error() says why. */
bool publisher_send(struct publisher* publisher, const struct server_frame* frame);
/* Its events alone. Must be open. */
void publisher_send_events(struct publisher* publisher, const struct server_frame* frame);

#endif
