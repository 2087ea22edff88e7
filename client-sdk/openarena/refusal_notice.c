/* SPDX-License-Identifier: GPL-2.0-or-later */
#include "refusal_notice.h"

#include <stdio.h>
#include <string.h>

#include "engine.h"

/* ms */
static const int32_t min_duration = 500, min_interval = 5000;

static bool is_due(const struct refusal_notice* notice, int32_t level_time) {
    return !notice->printed && (int64_t)level_time - notice->since >= min_duration &&
           (!notice->any_printed || (int64_t)level_time - notice->print_time >= min_interval);
}

void refusal_notice_update(struct refusal_notice* notice, int slot, const struct viewer_shot* shot,
                           int32_t level_time) {
    const bool refused =
        shot != NULL && (shot->state == CDIR_SHOT_REFUSED || shot->state == CDIR_SHOT_WAITING_FOR_MAP);
    if (refused && (!notice->refused || strcmp(notice->reason, shot->reason) != 0)) {
        notice->printed = false;
        notice->since = level_time;
        snprintf(notice->reason, sizeof notice->reason, "%s", shot->reason);
    }
    notice->refused = refused;
    if (!refused || !is_due(notice, level_time)) return;
    engine_print_line(slot, "director: no camera: %s%s", notice->reason,
                      shot->state == CDIR_SHOT_REFUSED
                          ? ". 'director profile NAME' asks for another profile, 'director off' for none"
                          : "");
    notice->printed = notice->any_printed = true;
    notice->print_time = level_time;
}
