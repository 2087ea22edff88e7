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
static const int64_t poll_ns = 250000;      /* while a frame is expected */
static const int64_t early_ns = 500000;     /* before the next frame is due */
static const int64_t idle_ns = 10000000;    /* longest sleep */
static const int64_t answers_ns = 10000000; /* between looks at all shots */
enum { max_backlog = 8 /* frames; the poses of older ones are not worth sending */ };

static struct {
    struct exchange* exchange;
    struct publisher publisher;
    struct shots shots;
    char record[sizeof((struct settings*)0)->record];
    struct recording* recording;
    bool recording_failed; /* in this life and with this prefix */
    struct director_report report;
    bool report_changed;
    const struct message* unrecorded; /* a frame that is published, and not released yet */
    bool cameras_arrived;             /* for a shot that is behind */

    int64_t now;           /* CLOCK_MONOTONIC */
    int64_t counts_time;   /* of the next report of the counts */
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
_Static_assert(error_size >= sizeof worker.publisher.match.error,
               "a text that is cut would be another each time");

static void set_error(char error[error_size], const char* text) {
    if (strcmp(error, text) == 0) return;
    snprintf(error, error_size, "%s", text);
    worker.report_changed = true;
    if (text[0] != '\0') log_line(error);
}

/* ------------------------------------------------------------------------------------------ the match */

static struct published_match* const match = &worker.publisher.match;

/* Takes what has become of the match into the report. */
static void report_match(void) {
    struct director_report* report = &worker.report;
    if ((report->directors > 0) != (match->directors > 0))
        log_line(match->directors > 0 ? "a director receives the match" : "no director receives the match");
    if (report->epoch != match->epoch || report->directors != match->directors) worker.report_changed = true;
    report->epoch = match->epoch;
    report->directors = match->directors;
    set_error(report->error, match->error);
}

static void send_frame(const struct server_frame* frame) {
    publisher_note_movers(&worker.publisher, frame);
    if (!match->open) {
        ++worker.report.skipped_frames;
    } else if (exchange_backlog(worker.exchange) > max_backlog) {
        ++worker.report.skipped_frames;
        publisher_send_events(&worker.publisher, frame);
    } else if (!publisher_send(&worker.publisher, frame)) {
        published_match_fail(match, worker.now);
    } else {
        shots_request(&worker.shots, match->context, match->wanted.settings.match_id, frame->viewers,
                      worker.now);
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
    if (!match->wanted.settings.enabled || worker.record[0] == '\0' || worker.recording_failed) return;
    if (worker.recording == NULL) {
        worker.recording =
            recording_open(worker.record, match->wanted.map, time(NULL), reason, sizeof reason);
        if (worker.recording == NULL) {
            worker.recording_failed = true;
            set_error(worker.report.recording_error, reason);
            return;
        }
        recording_set_players(worker.recording, match->wanted.players);
    }
    if (recording_add_frame(worker.recording, frame)) return;
    worker.recording_failed = true;
    close_recording();
}

/* --------------------------------------------------------------------------------------- the messages */

static bool runs(uint32_t life) {
    return match->in_life && match->wanted.life == life;
}

static void take_match(const struct match_message* message) {
    const struct match_state* wanted = &message->state;
    const bool new_life = !runs(wanted->life);
    const bool new_target = strcmp(worker.record, message->record) != 0 ||
                            match->wanted.settings.enabled != wanted->settings.enabled;
    if (new_life || new_target) {
        worker.recording_failed = false;
        set_error(worker.report.recording_error, "");
        close_recording();
    }
    if (new_life) {
        memset(worker.report.cameras, 0, sizeof worker.report.cameras);
        worker.report.life = wanted->life;
        worker.report_changed = true;
    }
    memcpy(worker.record, message->record, sizeof worker.record);
    if (worker.recording != NULL) recording_set_players(worker.recording, wanted->players);
    published_match_want(match, wanted, worker.now);
}

static void take_frame(const struct server_frame* frame) {
    if (!runs(frame->life)) return;
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
    if (runs(frame->life)) record_frame(frame);
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
            published_match_end_life(match, worker.now);
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

static void report_counts(void) {
    if (worker.now < worker.counts_time) return;
    worker.counts_time = worker.now + ns_per_s;
    worker.report.recorded_rows = worker.recording == NULL ? -1 : recording_rows(worker.recording);
    worker.report.published_frames = worker.publisher.frames;
    worker.report.published_events = worker.publisher.events;
    worker.report.failures = worker.publisher.failures;
    worker.report_changed = true;
}

static uint64_t shots_behind_newest(void) {
    return match->in_life ? shots_behind(&worker.shots, &worker.report, worker.level_time) : 0;
}

/* Each look at a shot takes some microseconds: at those alone for which something can have come. */
static void look_at_shots(void) {
    uint64_t slots = worker.cameras_arrived ? shots_behind_newest() : 0;
    worker.cameras_arrived = false;
    if (worker.now >= worker.answers_time) {
        worker.answers_time = worker.now + answers_ns;
        slots = UINT64_MAX;
    }
    if (shots_poll(&worker.shots, slots, match->epoch, &worker.report)) {
        worker.report_changed = true;
    }
}

static void report(void) {
    if (!worker.report_changed) return;
    worker.report_changed = !exchange_send_report(worker.exchange, &worker.report);
}

static int64_t time_to_wait(void) {
    if (!match->in_life || !match->wanted.settings.enabled) return idle_ns;
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
        published_match_look_after(match, worker.now);
        report_match();
        report_counts();
        report();
        wait_for_work();
    }
    record_published();
    close_recording();
    published_match_close(match);
}

bool worker_start(struct exchange* exchange) {
    worker.exchange = exchange;
    worker.report.recorded_rows = -1;
    for (int slot = 0; slot < max_slots; ++slot) {
        worker.report.shots[slot].state = CDIR_SHOT_NOT_REQUESTED;
    }
    return worker_thread_start(run, NULL);
}
