/* SPDX-License-Identifier: GPL-2.0-or-later */
/* The spectators' shots, on the worker: one observer of the client library for each. */
#ifndef CAMERA_DIRECTOR_OPENARENA_SHOTS_H
#define CAMERA_DIRECTOR_OPENARENA_SHOTS_H

#include "exchange.h"

/* All 0 = none. */
struct shots {
    struct shot {
        bool open;
        cdir_observer observer;
        struct viewer_request request; /* as requested */
    } slots[max_slots];
};

/* Opens, changes and closes the shots as the frame's viewers want. What fails is tried again with the next
 * frame. */
void shots_request(struct shots* shots, cdir_context context, const char* match_id,
                   const struct viewer_request viewers[max_slots]);
/* Takes what has arrived into the report's cameras and shots, as far as it is of `epoch`. Returns true when
 * something new did. */
bool shots_poll(struct shots* shots, uint64_t epoch, struct director_report* report);
/* Shots whose newest camera in the report is older than level_time. */
uint32_t shots_behind(const struct shots* shots, const struct director_report* report, int32_t level_time);
void shots_close(struct shots* shots);

#endif
