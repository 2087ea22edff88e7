/* SPDX-License-Identifier: GPL-2.0-or-later */
#include "take.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const double degrees_per_radian = 57.29577951308232;

/* A player without a row for this time has left, ms. */
static const double longest_gap = 250.0;
/* Movers have rows only while they move: one that follows after a longer time is where it moved to in its own
 * frame, ms. */
static const double longest_mover_step = 110.0;

enum {
    POSE_X = 2,
    POSE_PITCH = 5,
    POSE_VX = 8,
    POSE_VIEWHEIGHT = 11,
    POSE_TELEPORT_BIT = 12,
    POSE_ALIVE = 13,
    POSE_HEALTH = 14,
    POSE_WEAPON = 15
};
static const struct column pose_columns[] = {
    {"t_ms", true, 0},
    {"player", true, 0},
    {"x", true, 0},
    {"y", true, 0},
    {"z", true, 0},
    {"pitch", true, 0},
    {"yaw", true, 0},
    {"roll", false, 0},
    {"vx", true, 0},
    {"vy", true, 0},
    {"vz", true, 0},
    {"viewheight", true, 0},
    {"teleport_bit", true, 0},
    {"alive", true, 0},
    {"health", false, 100},
    {"weapon", false, 2 /* machine gun */},
};

enum { MOVER_X = 2, MOVER_PITCH = 5 };
static const struct column mover_columns[] = {
    {"t_ms", true, 0}, {"mover", true, 0}, {"x", true, 0},   {"y", true, 0},
    {"z", true, 0},    {"pitch", true, 0}, {"yaw", true, 0}, {"roll", true, 0},
};

enum { CAMERA_X = 2, CAMERA_QW = 5, CAMERA_CUT = 9 };
static const struct column camera_columns[] = {
    {"t_ms", true, 0}, {"player", true, 0}, {"x", true, 0},  {"y", true, 0},  {"z", true, 0},
    {"qw", true, 0},   {"qx", true, 0},     {"qy", true, 0}, {"qz", true, 0}, {"cut", true, 0},
};

enum { max_players = 48 };
enum { pose_column_count = sizeof pose_columns / sizeof *pose_columns };
enum { camera_column_count = sizeof camera_columns / sizeof *camera_columns };
enum { mover_column_count = sizeof mover_columns / sizeof *mover_columns };

/* Tracks of players: some, but not more than there are places for them beside the spectators. */
static bool read_players(struct tracks* tracks, const char* path, const struct column* columns,
                         size_t column_count, char* reason, size_t reason_size) {
    if (!tracks_read(tracks, path, columns, column_count, reason, reason_size)) return false;
    if (tracks->track_count > 0 && tracks->track_count <= max_players) return true;
    if (tracks->track_count == 0) {
        snprintf(reason, reason_size, "%s has no rows", path);
    } else {
        snprintf(reason, reason_size, "%s has more than %d players", path, (int)max_players);
    }
    return false;
}

bool take_open(struct take* take, const char* trace, const char* cameras, const char* movers, char* reason,
               size_t reason_size) {
    memset(take, 0, sizeof *take);
    if (!read_players(&take->poses, trace, pose_columns, pose_column_count, reason, reason_size) ||
        !read_players(&take->cameras, cameras, camera_columns, camera_column_count, reason, reason_size))
        return false;
    if (movers != NULL && movers[0] != '\0' &&
        !tracks_read(&take->movers, movers, mover_columns, mover_column_count, reason, reason_size))
        return false;
    take->first = HUGE_VAL;
    take->last = -HUGE_VAL;
    for (size_t i = 0; i < take->poses.track_count; ++i) {
        const struct track* const track = &take->poses.tracks[i];
        take->first = fmin(take->first, track->rows[COLUMN_TIME]);
        take->last = fmax(take->last, track->rows[(track->row_count - 1) * pose_column_count + COLUMN_TIME]);
    }
    return true;
}

void take_close(struct take* take) {
    tracks_free(&take->poses);
    tracks_free(&take->cameras);
    tracks_free(&take->movers);
}

static void interpolate(float vector[3], const struct span* span, size_t column) {
    for (size_t i = 0; i < 3; ++i) {
        const double before = span->before[column + i], after = span->after[column + i];
        vector[i] = (float)(before + (after - before) * span->fraction);
    }
}

static void interpolate_angles(float angles[3], const struct span* span, size_t column) {
    for (size_t i = 0; i < 3; ++i) {
        const double before = span->before[column + i];
        angles[i] = (float)(before + remainder(span->after[column + i] - before, 360.0) * span->fraction);
    }
}

struct recorded_pose take_pose(const struct take* take, size_t index, double time) {
    struct recorded_pose pose;
    memset(&pose, 0, sizeof pose);
    struct span span = track_at(&take->poses, &take->poses.tracks[index], time);
    if (span.before == NULL || time - span.before[COLUMN_TIME] > longest_gap) return pose;
    if (span.after[POSE_TELEPORT_BIT] != span.before[POSE_TELEPORT_BIT]) span.fraction = 0.0;
    pose.present = true;
    pose.alive = span.before[POSE_ALIVE] != 0.0;
    pose.teleport_bit = span.before[POSE_TELEPORT_BIT] != 0.0;
    pose.viewheight = (int)span.before[POSE_VIEWHEIGHT];
    pose.health = (int)span.before[POSE_HEALTH];
    pose.weapon = (int)span.before[POSE_WEAPON];
    interpolate(pose.origin, &span, POSE_X);
    interpolate(pose.velocity, &span, POSE_VX);
    interpolate_angles(pose.angles, &span, POSE_PITCH);
    return pose;
}

bool take_mover(const struct take* take, int model, double time, struct mover_pose* pose) {
    const struct track* const track = tracks_find(&take->movers, model);
    if (track == NULL) return false;
    struct span span = track_at(&take->movers, track, fmax(time, track->rows[COLUMN_TIME]));
    if (span.after[COLUMN_TIME] - span.before[COLUMN_TIME] > longest_mover_step) span.fraction = 0.0;
    memset(pose, 0, sizeof *pose);
    pose->model = (int16_t)model;
    interpolate(pose->origin, &span, MOVER_X);
    interpolate_angles(pose->angles, &span, MOVER_PITCH);
    return true;
}

/* v turned by the quaternion w x y z. */
static void turn(double turned[3], const double q[4], const double v[3]) {
    const double w = q[0], *u = q + 1;
    const double t[3] = {2 * (u[1] * v[2] - u[2] * v[1]), 2 * (u[2] * v[0] - u[0] * v[2]),
                         2 * (u[0] * v[1] - u[1] * v[0])};
    turned[0] = v[0] + w * t[0] + u[1] * t[2] - u[2] * t[1];
    turned[1] = v[1] + w * t[1] + u[2] * t[0] - u[0] * t[2];
    turned[2] = v[2] + w * t[2] + u[0] * t[1] - u[1] * t[0];
}

/* Pitch (positive looks down), yaw and roll of an orientation: x forward, y left, z up. */
static void angles_of(float angles[3], const double q[4]) {
    double forward[3], left[3];
    turn(forward, q, (const double[3]){1, 0, 0});
    turn(left, q, (const double[3]){0, 1, 0});
    const double pitch = -atan2(forward[2], hypot(forward[0], forward[1]));
    const double yaw = atan2(forward[1], forward[0]);
    const double level_left[3] = {-sin(yaw), cos(yaw), 0};
    const double level_up[3] = {sin(pitch) * cos(yaw), sin(pitch) * sin(yaw), cos(pitch)};
    const double roll = atan2(left[0] * level_up[0] + left[1] * level_up[1] + left[2] * level_up[2],
                              left[0] * level_left[0] + left[1] * level_left[1] + left[2] * level_left[2]);
    angles[0] = (float)(pitch * degrees_per_radian);
    angles[1] = (float)(yaw * degrees_per_radian);
    angles[2] = (float)(roll * degrees_per_radian);
}

/* Between two orientations along the shorter arc; they are so close in time that linear is enough. */
static void interpolate_orientation(double q[4], const struct span* span) {
    const double *before = span->before + CAMERA_QW, *after = span->after + CAMERA_QW;
    double dot = 0.0, length = 0.0;
    for (size_t i = 0; i < 4; ++i)
        dot += before[i] * after[i];
    for (size_t i = 0; i < 4; ++i) {
        q[i] = before[i] * (1.0 - span->fraction) + (dot < 0.0 ? -after[i] : after[i]) * span->fraction;
        length += q[i] * q[i];
    }
    length = sqrt(length);
    for (size_t i = 0; i < 4; ++i)
        q[i] = length > 0.0 ? q[i] / length : i == 0;
}

struct view take_view(const struct take* take, const struct track* camera, double before, double time,
                      bool* cut) {
    struct view view;
    double orientation[4];
    struct span span = track_at(&take->cameras, camera, fmax(time, camera->rows[COLUMN_TIME]));
    if (span.after[CAMERA_CUT] != 0.0) span.fraction = 0.0;
    *cut = track_marked(&take->cameras, camera, CAMERA_CUT, before, time);
    interpolate(view.position, &span, CAMERA_X);
    interpolate_orientation(orientation, &span);
    angles_of(view.angles, orientation);
    return view;
}
