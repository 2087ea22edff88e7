/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A game's match as the directors know it: over the game's lives, changes of its settings, failures and the
 * absence of directors. On the worker alone. Times are those of CLOCK_MONOTONIC in ns.
 */
#ifndef CAMERA_DIRECTOR_GAME_PUBLISHED_MATCH_H
#define CAMERA_DIRECTOR_GAME_PUBLISHED_MATCH_H

#include <camera_director/camera_director.h>
#include <stdbool.h>

#include "game/match_state.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Read by its owner, changed by the functions below. All 0 = closed, and nothing is wanted. */
struct published_match {
    bool open;
    cdir_context context; /* valid while open, as is the handle */
    cdir_match handle;
    uint64_t epoch;     /* 0 while closed */
    uint32_t directors; /* that received the poses at the last look; 0 while closed */
    char error[160];    /* why it is closed, in one line; "" = nothing has failed */

    bool in_life; /* `wanted` is of a life that has not ended */
    struct match_state wanted;

    int64_t retry_time; /* 0 = nothing is to be tried again */
    int64_t watch_time, life_end_time;
};

/* Says what is to be published from now on. Opens the match, begins a new epoch where the life differs from
 * before, or updates its description; opens it anew where it has another id or must be reached otherwise;
 * closes it where nothing is to be published. What has failed is tried again at once where the life or the
 * settings are others; else in its time. */
void published_match_want(struct published_match* match, const struct match_state* wanted, int64_t now);
/* The life has ended: the match is closed unless another one begins within a minute. */
void published_match_end_life(struct published_match* match, int64_t now);
/* A call of the client library for the match has just failed: closes it, to be opened anew after a second. */
void published_match_fail(struct published_match* match, int64_t now);
/* To be called at least some times a second. Tries again what has failed, counts the directors, and closes
 * the match when it is time for that. When the last director is lost it opens the match anew: one that only
 * hung takes up a lost connection after a minute, but a new one at once. */
void published_match_look_after(struct published_match* match, int64_t now);
/* Closes the context, too, with the observers that were opened in it. */
void published_match_close(struct published_match* match);

#ifdef __cplusplus
}
#endif

#endif
