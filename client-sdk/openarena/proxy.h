/* SPDX-License-Identifier: GPL-2.0-or-later */
/*
 * What the proxy knows and its parts may ask for. On the game's thread.
 */
#ifndef CAMERA_DIRECTOR_OPENARENA_PROXY_H
#define CAMERA_DIRECTOR_OPENARENA_PROXY_H

#include <stdint.h>

#include "frame.h"
#include "settings.h"

#ifdef __cplusplus
extern "C" {
#endif

struct proxy_counters {
    uint64_t frames;  /* server frames sampled, since the module was loaded */
    uint64_t dropped; /* of them, not handed to the worker: it was too far behind */
    uint64_t events;  /* in these frames */
    /* The module's own time on the game's thread, without the game's, in this life. */
    uint64_t timed_frames;
    int64_t total_ns;
    int64_t max_ns; /* of one frame */
};

const struct proxy_counters* module_counters(void);
const struct settings* module_settings(void);
/* The newest report of this life, or null. Valid until the next call. */
const struct director_report* module_report(void);
/* The cvar mapname at the start of this life. */
const char* module_map(void);
uint32_t module_life(void);

#ifdef __cplusplus
}
#endif

#endif
