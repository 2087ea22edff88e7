/* SPDX-License-Identifier: GPL-2.0-or-later */
/* The spectators' shots, on the worker: one observer of the client library for each. */
#ifndef CAMERA_DIRECTOR_OPENARENA_SHOTS_H
#define CAMERA_DIRECTOR_OPENARENA_SHOTS_H

#include "exchange.h"

#ifdef __cplusplus
extern "C" {
#endif

/* All 0 = none. They end with their context. */
struct shots {
    cdir_context context; /* of the observers */
    struct shot {
        bool open;
        cdir_observer observer;
        struct viewer_request request;                      /* as requested */
        char error[sizeof((struct viewer_shot*)0)->reason]; /* of the last attempt to request it; "" = none */
        int64_t retry_time;                                 /* no attempt before that */
    } slots[max_slots];
};

/* Opens, changes and closes the shots as the frame's viewers want, all anew in another context than before.
 * What fails is tried again after a second. now: CLOCK_MONOTONIC, ns. */
void shots_request(struct shots* shots, cdir_context context, const char* match_id,
                   const struct viewer_request viewers[max_slots], int64_t now);
/* The shots of these slots, as bits: those that are accepted and have no camera in the report that is as new
 * as level_time. */
uint64_t shots_behind(const struct shots* shots, const struct director_report* report, int32_t level_time);
/* Waits until something has arrived for the shot of one of these slots, of which there is at least one: all
 * receive the same cameras. As cdir_observer_wait(). */
cdir_status shots_wait(const struct shots* shots, uint64_t slots, int64_t timeout);
/* Takes what has arrived for these slots into the report's cameras and shots, as far as it is of `epoch`.
 * Returns true when something new did. */
bool shots_poll(struct shots* shots, uint64_t slots, uint64_t epoch, struct director_report* report);

#ifdef __cplusplus
}
#endif

#endif
