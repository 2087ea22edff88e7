/* SPDX-License-Identifier: GPL-2.0-or-later */
#include "viewers.h"

#include <string.h>

void viewers_reset(void) {}

void viewers_suspend(void) {}

void viewers_resume(void) {}

void viewers_connect(int slot, bool first_time) {
    (void)slot;
    (void)first_time;
}

void viewers_take_configstring(int number) {
    (void)number;
}

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
