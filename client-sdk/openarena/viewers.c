/* SPDX-License-Identifier: GPL-2.0-or-later */
#include "viewers.h"

#include <string.h>

void viewers_reset(void) {}

void viewers_restore(void) {}

void viewers_disconnect(int slot) {
    (void)slot;
}

void viewers_fill_requests(struct viewer_request requests[max_slots]) {
    memset(requests, 0, max_slots * sizeof *requests);
}

void viewers_apply(const struct director_report* report, const struct frame_history* history) {
    (void)report;
    (void)history;
}
