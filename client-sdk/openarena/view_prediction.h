/* SPDX-License-Identifier: GPL-2.0-or-later */
/*
 * Where a camera is by now. The director's newest camera was computed for the poses of an earlier server
 * frame; drawn as it is, it would trail its target by the target's motion since then. Pure functions.
 */
#ifndef CAMERA_DIRECTOR_OPENARENA_VIEW_PREDICTION_H
#define CAMERA_DIRECTOR_OPENARENA_VIEW_PREDICTION_H

#include <stdbool.h>

#include "frame.h"

#ifdef __cplusplus
extern "C" {
#endif

struct view {
    float position[3];
    float angles[3]; /* pitch (positive looks down), yaw, roll in degrees, -180 .. 180 */
};

/* The newest cameras of one segment. All zero before the first. */
struct camera_motion {
    uint8_t count; /* how many of the two are set, newest first */
    struct viewer_camera newest, previous;
};

/* Takes a live camera, the same one any number of times. Returns true when it begins a segment. */
bool camera_motion_take(struct camera_motion* motion, const struct viewer_camera* camera);

/* The view of motion->newest, count > 0, at a later level time.
 * It keeps moving at the velocity between the two cameras, for at most 25 ms, and by no more than the newest
 * one's clearance less one unit, within which there is no obstacle. Then it is turned so that the target's
 * eye keeps its place in the picture; then and now are the target's poses at the camera's time and at
 * level_time. Where either is null or the target died or jumped in between, the camera keeps turning as it
 * did. A camera that is held stands. */
struct view predict_view(const struct camera_motion* motion, int32_t level_time,
                         const struct player_pose* then, const struct player_pose* now);

/* The view of a camera as it is. */
struct view view_of_camera(const struct viewer_camera* camera);

#ifdef __cplusplus
}
#endif

#endif
