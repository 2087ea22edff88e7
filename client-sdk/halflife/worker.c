#include "worker.h"

#include <math.h>
#include <pthread.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static const int64_t live_sleep = 500000;              /* ns between looks into the ring during a map */
static const int64_t idle_sleep = 20000000;            /* ns otherwise */
static const int64_t retry_interval = 2000000000;      /* ns between attempts to open a match */
static const int64_t director_interval = 500000000;    /* ns between looks at the number of directors */
static const int64_t change_of_map_limit = 5000000000; /* ns without a map after which the match ends */

struct worker {
    struct exchange* exchange;
    pthread_t thread;
    atomic_bool stopping;

    /* The worker's thread only. Handles of id 0 are closed. */
    cdir_context context;
    cdir_match match;
    struct match_state announced; /* what context and match stand for */
    struct match_state wanted;
    bool in_map;
    bool failed; /* to announce what is wanted */
    int64_t failed_at, directors_read_at, map_ended_at;

    pthread_mutex_t status_mutex;
    struct worker_status status;
};

static int64_t monotonic_ns(void) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (int64_t)now.tv_sec * 1000000000 + now.tv_nsec;
}

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
    if (worker->context.id != 0) cdir_context_close(worker->context);
    worker->context.id = 0;
    worker->match.id = 0;
    pthread_mutex_lock(&worker->status_mutex);
    worker->status.open = false;
    worker->status.directors = 0;
    pthread_mutex_unlock(&worker->status_mutex);
}

static cdir_match_info match_info(const struct match_state* state) {
    cdir_match_info info = cdir_match_info_default();
    info.rate_hz = state->settings.max_rate_hz;
    snprintf(info.match_id, sizeof info.match_id, "%s", state->settings.match);
    snprintf(info.map_name, sizeof info.map_name, "%s", state->map);
    return info;
}

static uint32_t list_players(const struct match_state* state, cdir_player players[max_players]) {
    uint32_t player_count = 0;
    for (uint32_t i = 0; i < max_players; ++i) {
        const struct player_identity* identity = &state->players[i];
        if (!identity->present) continue;
        cdir_player* player = &players[player_count++];
        memset(player, 0, sizeof *player);
        player->id = i + 1;
        player->team = identity->team;
        snprintf(player->name, sizeof player->name, "%s", identity->name);
    }
    return player_count;
}

static bool same_match(const struct settings* a, const struct settings* b) {
    return a->domain == b->domain && strcmp(a->match, b->match) == 0 &&
           strcmp(a->network_interface, b->network_interface) == 0 && strcmp(a->directors, b->directors) == 0;
}

/* Opens, restarts or updates the match, so that it is the wanted one. */
static cdir_status announce(struct worker* worker) {
    const struct match_state* wanted = &worker->wanted;
    if (!same_match(&wanted->settings, &worker->announced.settings)) close_match(worker);
    if (!wanted->settings.enabled) {
        close_match(worker);
        return CDIR_OK;
    }
    const cdir_match_info info = match_info(wanted);
    cdir_player players[max_players];
    const uint32_t player_count = list_players(wanted, players);
    if (worker->match.id != 0) {
        return wanted->life == worker->announced.life
                   ? cdir_match_update(worker->match, &info, players, player_count)
                   : cdir_match_restart(worker->match, &info, players, player_count);
    }
    if (worker->context.id == 0) {
        cdir_context_options options = cdir_context_options_default();
        options.domain = wanted->settings.domain;
        options.network_interface = wanted->settings.network_interface;
        options.directors = wanted->settings.directors;
        const cdir_status status = cdir_context_open(&options, &worker->context);
        if (status < 0) return status;
    }
    return cdir_match_open(worker->context, &info, players, player_count, &worker->match);
}

static void try_to_announce(struct worker* worker) {
    worker->failed = announce(worker) < 0;
    set_error(worker, worker->failed ? cdir_last_error() : "");
    if (worker->failed) {
        worker->failed_at = monotonic_ns();
        close_match(worker);
        return;
    }
    worker->announced = worker->wanted;
    pthread_mutex_lock(&worker->status_mutex);
    worker->status.open = worker->match.id != 0;
    pthread_mutex_unlock(&worker->status_mutex);
}

/* Rotation about z by yaw, then about y by pitch, then about x by roll. */
static void quaternion(const float angles[3], float xyzw[4]) {
    const double half_degree = 3.14159265358979323846 / 360.0;
    const double pitch = (double)angles[0] * half_degree;
    const double yaw = (double)angles[1] * half_degree;
    const double roll = (double)angles[2] * half_degree;
    const double cp = cos(pitch), sp = sin(pitch), cy = cos(yaw), sy = sin(yaw), cr = cos(roll),
                 sr = sin(roll);
    xyzw[0] = (float)(sr * cp * cy - cr * sp * sy);
    xyzw[1] = (float)(cr * sp * cy + sr * cp * sy);
    xyzw[2] = (float)(cr * cp * sy - sr * sp * cy);
    xyzw[3] = (float)(cr * cp * cy + sr * sp * sy);
}

static void publish_event(struct worker* worker, const struct game_event* from, int64_t frame_time) {
    cdir_match_event event = cdir_match_event_default();
    event.kind = from->kind;
    event.frame_time = frame_time;
    event.actor = from->actor;
    event.subject = from->subject;
    event.value = from->value;
    memcpy(event.detail, from->detail, sizeof event.detail);
    const bool published = cdir_match_publish_event(worker->match, &event) >= 0;
    count(worker, published ? &worker->status.published_events : &worker->status.dropped_events);
}

static void publish_poses(struct worker* worker, const struct server_frame* from) {
    uint32_t ids[max_players], flags[max_players];
    float eyes[3 * max_players], orientations[4 * max_players], velocities[3 * max_players];
    for (uint32_t i = 0; i < from->player_count; ++i) {
        const struct player_pose* pose = &from->players[i];
        ids[i] = pose->id;
        flags[i] = pose->flags;
        memcpy(&eyes[3 * i], pose->eye, sizeof pose->eye);
        memcpy(&velocities[3 * i], pose->velocity, sizeof pose->velocity);
        quaternion(pose->angles, &orientations[4 * i]);
    }
    cdir_pose_frame frame = cdir_pose_frame_default();
    frame.player_count = from->player_count;
    frame.frame_time = from->frame_time;
    frame.source_time = from->source_time;
    frame.player_id = ids;
    frame.eye = eyes;
    frame.orientation = orientations;
    frame.velocity = velocities;
    frame.flags = flags;
    if (cdir_match_publish_poses(worker->match, &frame) < 0) {
        set_error(worker, cdir_last_error());
    } else {
        set_error(worker, "");
        count(worker, &worker->status.published_frames);
    }
}

static void handle(struct worker* worker, const struct message* message) {
    switch (message->kind) {
        case message_match:
            worker->in_map = true;
            worker->wanted = message->match;
            try_to_announce(worker);
            break;
        case message_frame:
            if (worker->match.id == 0) break;
            for (uint32_t i = 0; i < message->frame.event_count; ++i)
                publish_event(worker, &message->frame.events[i], message->frame.frame_time);
            publish_poses(worker, &message->frame);
            break;
        case message_end:
            worker->in_map = false;
            worker->failed = false;
            worker->map_ended_at = monotonic_ns();
            break;
    }
}

static void look_after_match(struct worker* worker) {
    const int64_t now = monotonic_ns();
    if (worker->failed && now >= worker->failed_at + retry_interval) try_to_announce(worker);
    if (worker->match.id == 0) return;
    if (!worker->in_map && now >= worker->map_ended_at + change_of_map_limit) {
        close_match(worker);
        return;
    }
    if (now < worker->directors_read_at + director_interval) return;
    worker->directors_read_at = now;
    uint32_t directors = 0;
    if (cdir_match_director_count(worker->match, &directors) < 0) return;
    pthread_mutex_lock(&worker->status_mutex);
    worker->status.directors = directors;
    pthread_mutex_unlock(&worker->status_mutex);
}

static void* run(void* argument) {
    struct worker* worker = argument;
    while (!atomic_load(&worker->stopping)) {
        const struct message* message = exchange_next(worker->exchange);
        if (message != NULL) {
            handle(worker, message);
            exchange_release(worker->exchange);
        } else {
            const struct timespec pause = {0, worker->in_map ? live_sleep : idle_sleep};
            nanosleep(&pause, NULL);
        }
        look_after_match(worker);
    }
    close_match(worker);
    return NULL;
}

struct worker* worker_start(struct exchange* exchange) {
    struct worker* worker = calloc(1, sizeof *worker);
    if (worker == NULL) return NULL;
    worker->exchange = exchange;
    pthread_mutex_init(&worker->status_mutex, NULL);
    /* The server's signals are for the server's threads. */
    sigset_t all, previous;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &previous);
    const int failure = pthread_create(&worker->thread, NULL, run, worker);
    pthread_sigmask(SIG_SETMASK, &previous, NULL);
    if (failure == 0) return worker;
    pthread_mutex_destroy(&worker->status_mutex);
    free(worker);
    return NULL;
}

void worker_stop(struct worker* worker) {
    atomic_store(&worker->stopping, true);
    pthread_join(worker->thread, NULL);
    pthread_mutex_destroy(&worker->status_mutex);
    free(worker);
}

struct worker_status worker_read_status(struct worker* worker) {
    pthread_mutex_lock(&worker->status_mutex);
    const struct worker_status status = worker->status;
    pthread_mutex_unlock(&worker->status_mutex);
    return status;
}
