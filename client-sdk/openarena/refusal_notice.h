/* SPDX-License-Identifier: GPL-2.0-or-later */
/* Tells a viewer on their console that the director refuses their shot, once for each refusal. */
#ifndef CAMERA_DIRECTOR_OPENARENA_REFUSAL_NOTICE_H
#define CAMERA_DIRECTOR_OPENARENA_REFUSAL_NOTICE_H

#include <stdbool.h>

#include "frame.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Of one viewer. All zero at first. */
struct refusal_notice {
    bool refused; /* the shot is, now */
    bool printed; /* that */
    bool any_printed;
    int32_t since, print_time; /* level times */
    char reason[sizeof((struct viewer_shot*)0)->reason];
};

/* In every frame. shot: null without a request. A refusal is printed when it has lasted for half a second, as
 * an answer to an earlier request does not, and five seconds after the last one at the earliest. */
void refusal_notice_update(struct refusal_notice* notice, int slot, const struct viewer_shot* shot,
                           int32_t level_time);

#ifdef __cplusplus
}
#endif

#endif
