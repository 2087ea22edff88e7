/*
 * The thread that talks to the directors through the client library: opens the match, begins an epoch with
 * every map, publishes poses and events.
 */
#ifndef CAMERA_DIRECTOR_HALFLIFE_WORKER_H
#define CAMERA_DIRECTOR_HALFLIFE_WORKER_H

#include <stdbool.h>
#include <stdint.h>

#include "game/ring.h"

struct worker;

struct worker_status {
    bool open; /* a match is announced */
    uint32_t directors;
    uint64_t published_frames, dropped_frames, published_events, dropped_events;
    char error[160]; /* why nothing is published; "" = all is well */
};

/* `messages` must outlive the worker, of which there is one at a time. Null when there is no memory or no
 * thread. */
struct worker* worker_start(struct ring* messages);
/* Ends the match and the thread, which takes some milliseconds. A process that exits ends them itself, before
 * the client library leaves the network; the worker must be stopped nevertheless. */
void worker_stop(struct worker* worker);
/* From any thread; waits for the worker to copy at most. */
struct worker_status worker_read_status(struct worker* worker);

#endif
