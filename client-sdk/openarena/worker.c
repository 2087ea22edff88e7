/* SPDX-License-Identifier: GPL-2.0-or-later */
#define _POSIX_C_SOURCE 200809L
#include "worker.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "game/thread.h"
#include "publisher.h"
#include "recording.h"
#include "shots.h"

static const int64_t ns_per_s = 1000000000, ns_per_ms = 1000000;
static const int64_t poll_ns = 250000;        /* while a frame is expected */
static const int64_t early_ns = 500000;       /* before the next frame is due */
static const int64_t idle_ns = 10000000;      /* longest sleep */
static const int64_t answers_ns = 10000000;   /* between looks at all shots */
static const int64_t retry_ns = 1000000000;   /* after a failure */
static const int64_t linger_ns = 60000000000; /* after a life's end, until the match is closed */
enum { max_backlog = 8 /* frames; the poses of older ones are not worth sending */ };

static struct {
    struct exchange* exchange;
    bool has_match; /* `match` is of a life that runs */
    struct match_state match;
    struct publisher publisher;
    struct shots shots;
    struct recording* recording;
    bool recording_failed; /* in this life and with this prefix */
    struct director_report report;
    bool report_changed;
    const struct message* unrecorded; /* a frame that is published, and not released yet */
    bool cameras_arrived;             /* for a shot that is behind */

    int64_t now;           /* CLOCK_MONOTONIC */
    int64_t retry_time;    /* not before: open the match */
    int64_t end_time;      /* of the last life */
    int64_t check_time;    /* of the next look at what changes seldom */
    int64_t answers_time;  /* of the next look at all shots */
    int64_t frame_arrival; /* of the newest frame */
    int64_t frame_period;
    int32_t level_time; /* of the newest frame */
} worker;

static void sleep_ns(int64_t duration) {
    const struct timespec time = {duration / ns_per_s, duration % ns_per_s};
    nanosleep(&time, NULL);
}

/* On standard error, which a dedicated server shows on its console: the engine may only be called on the
 * game's thread. */
static void log_line(const char* text) {
    fprintf(stderr, "camera director: %s\n", text);
}

enum { error_size = sizeof worker.report.error };

static void set_error(char error[error_size], const char* text) {
    if (strcmp(error, text) == 0) return;
    snprintf(error, error_size, "%s", text);
    worker.report_changed = true;
    if (text[0] != '\0') log_line(error);
}

/* ------------------------------------------------------------------------------------------ the match */

static void disconnect(void) {
    shots_close(&worker.shots);
    published_match_close(&worker.publisher.match);
    worker.report.epoch = 0;
    worker.report.directors = 0;
    worker.report_changed = true;
}

static void fail(void) {
    char text[error_size];
    snprintf(text, sizeof text, "%s", cdir_last_error());
    disconnect();
    set_error(worker.report.error, text);
    worker.retry_time = worker.now + retry_ns;
}

static void announce(void) {
    if (!worker.match.settings.enable) {
        disconnect();
        return;
    }
    if (worker.match.settings.error[0] != '\0') {
        disconnect();
        worker.retry_time = 0;
        set_error(worker.report.error, worker.match.settings.error);
        return;
    }
    if (worker.now < worker.retry_time) return;
    /* Where the match must be reached otherwise, its observers go with the old context. */
    const uint64_t context = worker.publisher.match.context.id;
    if (!publisher_announce(&worker.publisher, &worker.match)) {
        fail();
        return;
    }
    if (worker.publisher.match.context.id != context) shots_close(&worker.shots);
    worker_thread_stop_before_contexts();
    worker.report.epoch = worker.publisher.match.epoch;
    worker.retry_time = 0;
    set_error(worker.report.error, "");
}

static void send_frame(const struct server_frame* frame) {
    publisher_note_movers(&worker.publisher, frame);
    if (worker.retry_time != 0 && worker.now >= worker.retry_time) announce();
    if (!worker.publisher.match.open) {
        ++worker.report.skipped_frames;
    } else if (exchange_backlog(worker.exchange) > max_backlog) {
        ++worker.report.skipped_frames;
        publisher_send_events(&worker.publisher, frame);
    } else if (!publisher_send(&worker.publisher, frame)) {
        fail();
    } else {
        shots_request(&worker.shots, worker.publisher.match.context, worker.match.settings.match,
                      frame->viewers, worker.now);
    }
}

/* -------------------------------------------------------------------------------------- the recording */

static void close_recording(void) {
    char reason[error_size];
    if (worker.recording == NULL) return;
    if (!recording_close(worker.recording, reason, sizeof reason))
        set_error(worker.report.recording_error, reason);
    worker.recording = NULL;
}

static void record_frame(const struct server_frame* frame) {
    char reason[error_size];
    const struct settings* settings = &worker.match.settings;
    if (!settings->enable || settings->record[0] == '\0' || worker.recording_failed) return;
    if (worker.recording == NULL) {
        worker.recording =
            recording_open(settings->record, worker.match.map, time(NULL), reason, sizeof reason);
        if (worker.recording == NULL) {
            worker.recording_failed = true;
            set_error(worker.report.recording_error, reason);
            return;
        }
        recording_set_players(worker.recording, worker.match.players);
    }
    if (recording_add_frame(worker.recording, frame)) return;
    worker.recording_failed = true;
    close_recording();
}

/* --------------------------------------------------------------------------------------- the messages */

static void take_match(const struct match_state* match) {
    const bool new_life = !worker.has_match || worker.match.life != match->life;
    const bool new_target = strcmp(worker.match.settings.record, match->settings.record) != 0 ||
                            worker.match.settings.enable != match->settings.enable;
    if (new_life || new_target) {
        worker.recording_failed = false;
        set_error(worker.report.recording_error, "");
        close_recording();
    }
    if (new_life) {
        memset(worker.report.cameras, 0, sizeof worker.report.cameras);
        worker.report.life = match->life;
        worker.report_changed = true;
    }
    if (!match->settings.enable) set_error(worker.report.error, "");
    worker.match = *match;
    worker.has_match = true;
    if (worker.recording != NULL) recording_set_players(worker.recording, match->players);
    announce();
}

static void take_frame(const struct server_frame* frame) {
    if (!worker.has_match || frame->life != worker.match.life) return;
    const int64_t period = (int64_t)(frame->level_time - worker.level_time) * ns_per_ms;
    worker.frame_period = period > 0 && period < ns_per_s / 5 ? period : ns_per_s / 60;
    worker.frame_arrival = worker.now;
    worker.level_time = frame->level_time;
    send_frame(frame);
}

/* Once nothing else is to be done: a disk may be slow. */
static void record_published(void) {
    if (worker.unrecorded == NULL) return;
    const struct server_frame* frame = &worker.unrecorded->frame;
    if (worker.has_match && frame->life == worker.match.life) record_frame(frame);
    worker.unrecorded = NULL;
    exchange_release_message(worker.exchange);
}

static void take_message(const struct message* message) {
    switch (message->header.kind) {
        case message_match:
            take_match(&message->match);
            break;
        case message_frame:
            take_frame(&message->frame);
            worker.unrecorded = message;
            return;
        case message_end:
            close_recording();
            worker.has_match = false;
            worker.end_time = worker.now;
            break;
    }
    exchange_release_message(worker.exchange);
}

static void take_messages(void) {
    while (!worker_thread_must_stop()) {
        const uint32_t published = worker.unrecorded != NULL ? 1 : 0;
        if (exchange_backlog(worker.exchange) == published) return;
        record_published();
        worker.now = clock_ns(CLOCK_MONOTONIC);
        take_message(exchange_next_message(worker.exchange));
    }
}

/* ------------------------------------------------------------------------------------------- the loop */

static void check_directors(void) {
    const uint32_t directors = published_match_directors(&worker.publisher.match),
                   before = worker.report.directors;
    worker.report.directors = directors;
    if (directors > 0 && before == 0) log_line("a director receives the match");
    if (directors == 0 && before > 0) {
        log_line("no director receives the match");
        /* One that only hung takes up a lost connection after a minute, but a new one at once. */
        disconnect();
        if (worker.has_match) announce();
    }
    worker.report.recorded_rows = worker.recording == NULL ? -1 : recording_rows(worker.recording);
    worker.report.published_frames = worker.publisher.frames;
    worker.report.published_events = worker.publisher.events;
    worker.report.failures = worker.publisher.failures;
    worker.report_changed = true;
}

static void check_match(void) {
    if (!worker.has_match && worker.publisher.match.open && worker.now - worker.end_time > linger_ns)
        disconnect();
    if (worker.now < worker.check_time) return;
    worker.check_time = worker.now + ns_per_s;
    check_directors();
}

static uint64_t shots_behind_newest(void) {
    return worker.has_match ? shots_behind(&worker.shots, &worker.report, worker.level_time) : 0;
}

/* Each look at a shot takes some microseconds: at those alone for which something can have come. */
static void look_at_shots(void) {
    uint64_t slots = worker.cameras_arrived ? shots_behind_newest() : 0;
    worker.cameras_arrived = false;
    if (worker.now >= worker.answers_time) {
        worker.answers_time = worker.now + answers_ns;
        slots = UINT64_MAX;
    }
    if (shots_poll(&worker.shots, slots, worker.publisher.match.epoch, &worker.report)) {
        worker.report_changed = true;
    }
}

static void report(void) {
    if (!worker.report_changed) return;
    worker.report_changed = !exchange_send_report(worker.exchange, &worker.report);
}

static int64_t time_to_wait(void) {
    if (!worker.has_match || !worker.match.settings.enable) return idle_ns;
    const int64_t age = worker.now - worker.frame_arrival, due = worker.frame_period - early_ns;
    if (age > 4 * worker.frame_period) return 4 * poll_ns; /* no frames: the server hangs */
    if (age >= due) return poll_ns;
    return due - age < idle_ns ? due - age : idle_ns;
}

/* Until a frame or a camera is expected to have come. */
static void wait_for_work(void) {
    const uint64_t behind = shots_behind_newest();
    const int64_t record_time = worker.frame_arrival + worker.frame_period / 2; /* whatever is missing */
    if (behind == 0 || worker.now >= record_time) record_published();
    worker.now = clock_ns(CLOCK_MONOTONIC);
    int64_t duration = time_to_wait();
    if (worker.unrecorded != NULL && worker.now + duration > record_time) duration = poll_ns;
    const cdir_status status = behind != 0 ? shots_wait(&worker.shots, behind, duration) : CDIR_NO_DATA;
    worker.cameras_arrived = status == CDIR_OK;
    if (status != CDIR_OK && status != CDIR_TIMEOUT) sleep_ns(duration);
}

static void run(void* unused) {
    (void)unused;
    while (!worker_thread_must_stop()) {
        worker.now = clock_ns(CLOCK_MONOTONIC);
        take_messages();
        look_at_shots();
        check_match();
        report();
        wait_for_work();
    }
    record_published();
    close_recording();
    disconnect();
}

bool worker_start(struct exchange* exchange) {
    worker.exchange = exchange;
    worker.report.recorded_rows = -1;
    for (int slot = 0; slot < max_slots; ++slot) {
        worker.report.shots[slot].state = CDIR_SHOT_NOT_REQUESTED;
    }
    return worker_thread_start(run, NULL);
}
