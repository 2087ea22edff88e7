/* SPDX-License-Identifier: GPL-2.0-or-later */
#include "tracks.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

enum { max_line = 1024, max_fields = 64, largest_number = 999999 };

static const size_t max_rows = 1u << 22; /* of a player: 19 hours at 60 Hz */

/* Where in the file, for messages. */
struct source {
    const char* path;
    size_t line;
};

static bool fail(const struct source* source, char* reason, size_t reason_size, const char* what,
                 const char* subject) {
    snprintf(reason, reason_size, "%s, line %zu: %s '%.60s'", source->path, source->line, what, subject);
    return false;
}

/* Splits a line at its commas, in place. */
static size_t split(char* line, char* fields[max_fields]) {
    size_t count = 0;
    line[strcspn(line, "\r\n")] = '\0';
    for (char* next = line; next != NULL && count < max_fields; ++count) {
        fields[count] = next;
        next = strchr(next, ',');
        if (next != NULL) *next++ = '\0';
    }
    return count;
}

static struct track* find_or_add(struct tracks* tracks, int player) {
    size_t i = 0;
    while (i < tracks->track_count && tracks->tracks[i].player < player)
        ++i;
    struct track* const track = &tracks->tracks[i];
    if (i < tracks->track_count && track->player == player) return track;
    if (tracks->track_count == max_tracks) return NULL;
    memmove(track + 1, track, (tracks->track_count - i) * sizeof *track);
    memset(track, 0, sizeof *track);
    track->player = player;
    ++tracks->track_count;
    return track;
}

static double* add_row(const struct tracks* tracks, struct track* track) {
    if (track->row_count == track->capacity) {
        const size_t capacity = track->capacity == 0 ? 1024 : 2 * track->capacity;
        double* const rows =
            capacity > max_rows ? NULL : realloc(track->rows, capacity * tracks->column_count * sizeof *rows);
        if (rows == NULL) return NULL;
        track->rows = rows;
        track->capacity = capacity;
    }
    return track->rows + tracks->column_count * track->row_count++;
}

static double time_of(const struct tracks* tracks, const struct track* track, size_t row) {
    return track->rows[row * tracks->column_count + COLUMN_TIME];
}

static bool take_row(struct tracks* tracks, const double values[max_columns], const char* owner,
                     const struct source* source, char* reason, size_t reason_size) {
    const double number = values[COLUMN_PLAYER];
    if (number < 0 || number > largest_number || number != floor(number))
        return fail(source, reason, reason_size, "expected a whole number from 0 on in column", owner);
    struct track* const track = find_or_add(tracks, (int)number);
    if (track == NULL)
        return fail(source, reason, reason_size, "more different ones than can be shown in column", owner);
    if (track->row_count > 0 && values[COLUMN_TIME] < time_of(tracks, track, track->row_count - 1))
        return fail(source, reason, reason_size, "a time before the previous one of the same", owner);
    double* const row = add_row(tracks, track);
    if (row == NULL)
        return fail(source, reason, reason_size, "no room for more rows (at most 4194304) of a", owner);
    memcpy(row, values, tracks->column_count * sizeof *row);
    return true;
}

/* places[i]: the field of columns[i], or max_fields. */
static bool read_header(char* line, const struct column* columns, size_t column_count, size_t* places,
                        const struct source* source, char* reason, size_t reason_size) {
    char* fields[max_fields];
    const size_t count = split(line, fields);
    for (size_t i = 0; i < column_count; ++i) {
        places[i] = max_fields;
        for (size_t field = 0; field < count; ++field) {
            if (strcmp(fields[field], columns[i].name) == 0) places[i] = field;
        }
        if (places[i] == max_fields && columns[i].required)
            return fail(source, reason, reason_size, "the header lacks the column", columns[i].name);
    }
    return true;
}

static bool read_rows(gzFile file, struct tracks* tracks, const struct column* columns, struct source* source,
                      char* reason, size_t reason_size) {
    char line[max_line];
    char* fields[max_fields];
    size_t places[max_columns];
    for (; gzgets(file, line, sizeof line) != NULL; ++source->line) {
        if (strlen(line) == max_line - 1) return fail(source, reason, reason_size, "too long:", line);
        if (source->line == 1) {
            if (!read_header(line, columns, tracks->column_count, places, source, reason, reason_size))
                return false;
            continue;
        }
        const size_t count = split(line, fields);
        if (count == 1 && fields[0][0] == '\0') continue;
        double values[max_columns];
        for (size_t i = 0; i < tracks->column_count; ++i) {
            values[i] = columns[i].otherwise;
            if (places[i] == max_fields) continue;
            char* end = NULL;
            if (places[i] < count) values[i] = strtod(fields[places[i]], &end);
            if (end == NULL || end == fields[places[i]] || *end != '\0' || !isfinite(values[i]))
                return fail(source, reason, reason_size, "expected a number in column", columns[i].name);
        }
        if (!take_row(tracks, values, columns[COLUMN_PLAYER].name, source, reason, reason_size)) return false;
    }
    return true;
}

bool tracks_read(struct tracks* tracks, const char* path, const struct column* columns, size_t column_count,
                 char* reason, size_t reason_size) {
    struct source source = {path, 1};
    memset(tracks, 0, sizeof *tracks);
    tracks->column_count = column_count;
    const gzFile file = gzopen(path, "rb");
    if (file == NULL) {
        snprintf(reason, reason_size, "%s cannot be opened", path);
        return false;
    }
    bool read = read_rows(file, tracks, columns, &source, reason, reason_size);
    int error; /* gzgets() does not distinguish it from the end, and gzclose() knows only of a file cut off */
    gzerror(file, &error);
    if ((gzclose(file) != Z_OK || error != Z_OK) && read)
        read = fail(&source, reason, reason_size, "damaged or cut off:", path);
    return read;
}

void tracks_free(struct tracks* tracks) {
    for (size_t i = 0; i < tracks->track_count; ++i)
        free(tracks->tracks[i].rows);
    memset(tracks, 0, sizeof *tracks);
}

const struct track* tracks_find(const struct tracks* tracks, int player) {
    for (size_t i = 0; i < tracks->track_count; ++i) {
        if (tracks->tracks[i].player == player) return &tracks->tracks[i];
    }
    return NULL;
}

/* The number of rows up to a time. */
static size_t rows_until(const struct tracks* tracks, const struct track* track, double time) {
    size_t first = 0, last = track->row_count;
    while (first < last) {
        const size_t middle = first + (last - first) / 2;
        if (time_of(tracks, track, middle) <= time)
            first = middle + 1;
        else
            last = middle;
    }
    return first;
}

struct span track_at(const struct tracks* tracks, const struct track* track, double time) {
    struct span span = {NULL, NULL, 0.0};
    const size_t rows = rows_until(tracks, track, time);
    if (rows == 0) return span;
    span.before = track->rows + (rows - 1) * tracks->column_count;
    span.after = span.before;
    if (rows == track->row_count) return span;
    span.after += tracks->column_count;
    const double start = span.before[COLUMN_TIME];
    span.fraction = (time - start) / (span.after[COLUMN_TIME] - start);
    return span;
}

bool track_marked(const struct tracks* tracks, const struct track* track, size_t column, double from,
                  double to) {
    for (size_t row = rows_until(tracks, track, from); row < rows_until(tracks, track, to); ++row) {
        if (track->rows[row * tracks->column_count + column] != 0.0) return true;
    }
    return false;
}
