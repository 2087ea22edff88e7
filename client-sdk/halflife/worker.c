#include "worker.h"

#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "frame.h"
#include "game/published_match.h"
#include "game/thread.h"

static const int64_t live_sleep = 500000;               /* ns between looks into the ring during a map */
static const int64_t idle_sleep = 20000000;             /* ns otherwise */
static const int64_t retry_interval = 2000000000;       /* ns between attempts to open a match */
static const int64_t director_interval = 500000000;     /* ns between looks at the number of directors */
static const int64_t change_of_map_limit = 60000000000; /* ns without a map after which the match ends */

struct worker {
    struct ring* messages;

    /* The worker's thread only. */
    struct published_match match;
    struct match_state wanted;
    bool in_map;
    bool failed; /* to announce what is wanted */
    int64_t failed_at, directors_read_at, map_ended_at;

    pthread_mutex_t status_mutex;
    struct worker_status status;
};

static void set_error(struct worker* worker, const char* text) {
    pthread_mutex_lock(&worker->status_mutex);
    snprintf(worker->status.error, sizeof worker->status.error, "%s", text);
    pthread_mutex_unlock(&worker->status_mutex);
}

static void count(struct worker* worker, uint64_t* counter) {
    pthread_mutex_lock(&worker->status_mutex);
    ++*counter;
    pthread_mutex_unlock(&worker->status_mutex);
}

static void close_match(struct worker* worker) {
    published_match_close(&worker->match);
    pthread_mutex_lock(&worker->status_mutex);
    worker->status.open = false;
    worker->status.directors = 0;
    pthread_mutex_unlock(&worker->status_mutex);
}

static uint32_t list_players(const struct match_state* state, cdir_player players[max_players]) {
    uint32_t player_count = 0;
    for (uint32_t i = 0; i < max_players; ++i) {
        const struct player_identity* identity = &state->players[i];
        if (!identity->present) continue;
        cdir_player* player = &players[player_count++];
        *player = cdir_player_default();
        player->id = i + 1;
        player->team = identity->team;
        snprintf(player->name, sizeof player->name, "%s", identity->name);
    }
    return player_count;
}

static bool announce(struct worker* worker) {
    const struct match_state* wanted = &worker->wanted;
    cdir_context_options options = cdir_context_options_default();
    options.domain = wanted->settings.domain;
    options.network_interface = wanted->settings.network_interface;
    options.directors = wanted->settings.directors;
    cdir_match_info info = cdir_match_info_default();
    info.rate_hz = wanted->settings.max_rate_hz;
    snprintf(info.match_id, sizeof info.match_id, "%s", wanted->settings.match);
    snprintf(info.map_name, sizeof info.map_name, "%s", wanted->map);
    cdir_player players[max_players];
    const uint32_t player_count = list_players(wanted, players);
    return published_match_announce(&worker->match, &options, wanted->life, &info, players, player_count);
}

/* Returns why nothing can be published; "" when the match is announced. */
static const char* announced_or_why_not(struct worker* worker) {
    if (worker->wanted.settings.error[0] != '\0') return worker->wanted.settings.error;
    if (!announce(worker)) return cdir_last_error();
    worker_thread_stop_before_contexts();
    return "";
}

static void try_to_announce(struct worker* worker) {
    const bool enabled = worker->wanted.settings.enabled != 0;
    const char* error = enabled ? announced_or_why_not(worker) : "";
    set_error(worker, error);
    worker->failed = error[0] != '\0';
    if (worker->failed) worker->failed_at = clock_ns(CLOCK_MONOTONIC);
    if (worker->failed || !enabled) {
        close_match(worker);
        return;
    }
    pthread_mutex_lock(&worker->status_mutex);
    worker->status.open = true;
    pthread_mutex_unlock(&worker->status_mutex);
}

static void publish_event(struct worker* worker, const struct game_event* from, int64_t frame_time) {
    cdir_match_event event = cdir_match_event_default();
    event.kind = from->kind;
    event.frame_time = frame_time;
    event.actor = from->actor;
    event.subject = from->subject;
    event.value = from->value;
    memcpy(event.detail, from->detail, sizeof event.detail);
    const bool published = cdir_match_publish_event(worker->match.handle, &event) >= 0;
    count(worker, published ? &worker->status.published_events : &worker->status.dropped_events);
}

static void publish_poses(struct worker* worker, const struct server_frame* from) {
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
    if (cdir_match_publish_poses(worker->match.handle, &frame) < 0) {
        set_error(worker, cdir_last_error());
    } else {
        set_error(worker, "");
        count(worker, &worker->status.published_frames);
    }
}

static void handle(struct worker* worker, const struct message* message) {
    switch (message->header.kind) {
        case message_match:
            worker->in_map = true;
            worker->wanted = message->match;
            try_to_announce(worker);
            break;
        case message_frame:
            if (!worker->match.open) break;
            for (uint32_t i = 0; i < message->frame.event_count; ++i)
                publish_event(worker, &message->frame.events[i], message->frame.frame_time);
            publish_poses(worker, &message->frame);
            break;
        case message_end:
            worker->in_map = false;
            worker->failed = false;
            worker->map_ended_at = clock_ns(CLOCK_MONOTONIC);
            break;
    }
}

static void count_directors(struct worker* worker) {
    const uint32_t directors = published_match_directors(&worker->match);
    pthread_mutex_lock(&worker->status_mutex);
    const uint32_t before = worker->status.directors;
    worker->status.directors = directors;
    pthread_mutex_unlock(&worker->status_mutex);
    if (directors > 0 || before == 0) return;
    /* One that only hung takes up a lost connection after a minute, but a new one at once. */
    close_match(worker);
    if (worker->in_map) try_to_announce(worker);
}

static void look_after_match(struct worker* worker) {
    const int64_t now = clock_ns(CLOCK_MONOTONIC);
    if (worker->failed && now >= worker->failed_at + retry_interval) try_to_announce(worker);
    if (!worker->match.open) return;
    if (!worker->in_map && now >= worker->map_ended_at + change_of_map_limit) {
        close_match(worker);
    } else if (now >= worker->directors_read_at + director_interval) {
        worker->directors_read_at = now;
        count_directors(worker);
    }
}

static void run(void* argument) {
    struct worker* worker = argument;
    while (!worker_thread_must_stop()) {
        const struct message* message = ring_oldest(worker->messages);
        if (message != NULL) {
            handle(worker, message);
            ring_release(worker->messages);
        } else {
            const bool live = worker->in_map && worker->wanted.settings.enabled;
            const struct timespec pause = {0, live ? live_sleep : idle_sleep};
            nanosleep(&pause, NULL);
        }
        look_after_match(worker);
    }
    close_match(worker);
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
