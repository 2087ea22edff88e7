#include "worker.h"

#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "frame.h"
#include "game/published_match.h"
#include "game/thread.h"

static const int64_t live_sleep = 500000;   /* ns between looks into the ring during a map */
static const int64_t idle_sleep = 20000000; /* ns otherwise */

struct worker {
    struct ring* messages;

    /* The worker's thread only. */
    struct published_match match;
    uint64_t published_frames, dropped_frames, published_events, dropped_events;

    pthread_mutex_t status_mutex;
    struct worker_status status;
};

static void publish_event(struct worker* worker, const struct game_event* from, int64_t frame_time) {
    cdir_match_event event = cdir_match_event_default();
    event.kind = from->kind;
    event.frame_time = frame_time;
    event.actor = from->actor;
    event.subject = from->subject;
    event.value = from->value;
    memcpy(event.detail, from->detail, sizeof event.detail);
    const bool published = cdir_match_publish_event(worker->match.handle, &event) >= 0;
    ++*(published ? &worker->published_events : &worker->dropped_events);
}

static bool publish_poses(struct worker* worker, const struct server_frame* from) {
    const struct player_pose* poses = from->players;
    float orientations[4 * max_players];
    for (uint32_t i = 0; i < from->player_count; ++i)
        (void)cdir_orientation_from_angles(poses[i].angles, &orientations[4 * i]);
    cdir_pose_frame frame = cdir_pose_frame_default();
    frame.player_count = from->player_count;
    frame.frame_time = from->frame_time;
    frame.source_time = from->source_time;
    frame.player_id = &poses->id;
    frame.eye = poses->eye;
    frame.orientation = orientations;
    frame.velocity = poses->velocity;
    frame.flags = &poses->flags;
    frame.player_id_stride = frame.eye_stride = frame.velocity_stride = frame.flags_stride = sizeof *poses;
    return cdir_match_publish_poses(worker->match.handle, &frame) >= 0;
}

static void publish_frame(struct worker* worker, const struct server_frame* frame, int64_t now) {
    if (!worker->match.open) {
        ++worker->dropped_frames;
        worker->dropped_events += frame->event_count;
        return;
    }
    for (uint32_t i = 0; i < frame->event_count; ++i)
        publish_event(worker, &frame->events[i], frame->frame_time);
    if (publish_poses(worker, frame)) {
        ++worker->published_frames;
    } else {
        ++worker->dropped_frames;
        published_match_fail(&worker->match, now);
    }
}

static void handle(struct worker* worker, const struct message* message, int64_t now) {
    switch (message->header.kind) {
        case message_match:
            published_match_want(&worker->match, &message->match, now);
            break;
        case message_frame:
            publish_frame(worker, &message->frame, now);
            break;
        case message_end:
            published_match_end_life(&worker->match, now);
            break;
    }
}

static void write_status(struct worker* worker) {
    struct worker_status status = {.open = worker->match.open,
                                   .directors = worker->match.directors,
                                   .published_frames = worker->published_frames,
                                   .dropped_frames = worker->dropped_frames,
                                   .published_events = worker->published_events,
                                   .dropped_events = worker->dropped_events};
    snprintf(status.error, sizeof status.error, "%s", worker->match.error);
    pthread_mutex_lock(&worker->status_mutex);
    worker->status = status;
    pthread_mutex_unlock(&worker->status_mutex);
}

static void wait_for_messages(const struct worker* worker) {
    const bool live = worker->match.in_life && worker->match.wanted.settings.enabled;
    const struct timespec pause = {0, live ? live_sleep : idle_sleep};
    nanosleep(&pause, NULL);
}

static void run(void* argument) {
    struct worker* worker = argument;
    while (!worker_thread_must_stop()) {
        const int64_t now = clock_ns(CLOCK_MONOTONIC);
        const struct message* message = ring_oldest(worker->messages);
        if (message != NULL) {
            handle(worker, message, now);
            ring_release(worker->messages);
        }
        published_match_look_after(&worker->match, now);
        write_status(worker);
        if (message == NULL) wait_for_messages(worker);
    }
    published_match_close(&worker->match);
}

struct worker* worker_start(struct ring* messages) {
    struct worker* worker = calloc(1, sizeof *worker);
    if (worker == NULL) return NULL;
    worker->messages = messages;
    pthread_mutex_init(&worker->status_mutex, NULL);
    if (worker_thread_start(run, worker)) return worker;
    pthread_mutex_destroy(&worker->status_mutex);
    free(worker);
    return NULL;
}

void worker_stop(struct worker* worker) {
    worker_thread_stop();
    pthread_mutex_destroy(&worker->status_mutex);
    free(worker);
}

struct worker_status worker_read_status(struct worker* worker) {
    pthread_mutex_lock(&worker->status_mutex);
    const struct worker_status status = worker->status;
    pthread_mutex_unlock(&worker->status_mutex);
    return status;
}
