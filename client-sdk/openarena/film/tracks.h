/* SPDX-License-Identifier: GPL-2.0-or-later */
/* A CSV file (plain or .gz) of values over time, sorted into one track for each player or mover. */
#ifndef CAMERA_DIRECTOR_OPENARENA_FILM_TRACKS_H
#define CAMERA_DIRECTOR_OPENARENA_FILM_TRACKS_H

#include <stdbool.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { max_tracks = 256, max_columns = 16 };
/* The first two columns of every file. */
enum { COLUMN_TIME = 0 /* ms, never decreasing within a track */, COLUMN_PLAYER = 1 /* or mover */ };

struct column {
    const char* name; /* in the header, where columns come in any order and others are ignored */
    bool required;
    double otherwise; /* value where the file has no such column */
};

struct track {
    int player;
    size_t row_count, capacity;
    double* rows; /* row_count x column_count */
};

struct tracks {
    size_t column_count, track_count;
    struct track tracks[max_tracks]; /* by player */
};

/* The rows around a time: before->time <= time < after->time. After the last row both are the last one; null
 * before the first one. */
struct span {
    const double *before, *after;
    double fraction; /* 0 at before, 1 at after */
};

/* Returns false and stores what is wrong, and where, in reason. A file without rows gives no tracks. Numbers
 * are finite. tracks_free() afterwards
 * in both cases. */
bool tracks_read(struct tracks* tracks, const char* path, const struct column* columns, size_t column_count,
                 char* reason, size_t reason_size);
void tracks_free(struct tracks* tracks);

/* Null when there is none. */
const struct track* tracks_find(const struct tracks* tracks, int player);
struct span track_at(const struct tracks* tracks, const struct track* track, double time);
/* Whether a row with a value other than 0 in `column` lies in (from, to]. */
bool track_marked(const struct tracks* tracks, const struct track* track, size_t column, double from,
                  double to);

#ifdef __cplusplus
}
#endif

#endif
