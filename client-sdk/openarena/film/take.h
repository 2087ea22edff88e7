/* SPDX-License-Identifier: GPL-2.0-or-later */
/* A recorded match and camera paths of its players, at any time between the recorded ones. */
#ifndef CAMERA_DIRECTOR_OPENARENA_FILM_TAKE_H
#define CAMERA_DIRECTOR_OPENARENA_FILM_TAKE_H

#include <stdbool.h>

#include "frame.h"
#include "tracks.h"
#include "view_prediction.h"

#ifdef __cplusplus
extern "C" {
#endif

struct recorded_pose {
    bool present; /* in the match at this time; all else is 0 otherwise */
    bool alive;
    int teleport_bit, viewheight, health, weapon;
    float origin[3], velocity[3], angles[3]; /* pitch, yaw, roll in degrees */
};

struct take {
    struct tracks poses, cameras, movers; /* movers: none where there is no file of them */
    double first, last;                   /* times of the first and the last pose, ms */
};

/* movers: null or "" = none. Returns false and stores what is wrong in reason. take_close() afterwards in
 * both cases. */
bool take_open(struct take* take, const char* trace, const char* cameras, const char* movers, char* reason,
               size_t reason_size);
void take_close(struct take* take);

/* index < poses.track_count. */
struct recorded_pose take_pose(const struct take* take, size_t index, double time);
/* Of an inline brush model. Returns false when it is not in the file. */
bool take_mover(const struct take* take, int model, double time, struct mover_pose* pose);
/* The camera of a player; the first one before its path begins. cut: the path has a cut in (before, time]. */
struct view take_view(const struct take* take, const struct track* camera, double before, double time,
                      bool* cut);

#ifdef __cplusplus
}
#endif

#endif
