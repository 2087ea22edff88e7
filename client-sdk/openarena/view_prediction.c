/* SPDX-License-Identifier: GPL-2.0-or-later */
#include "view_prediction.h"

#include <math.h>

static const double degrees = 57.295779513082321;
static const double max_pitch = 89.0;     /* beyond it the picture would turn over */
static const double min_eye_distance = 4; /* closer, the direction of the eye means nothing */
static const double max_move = 1000;
/* ms. A longer one errs no less, where a camera follows a player round corners, and makes its path rougher.
 */
static const double max_extrapolation = 25;

static double wrapped(double angle) {
    return angle - 360.0 * floor((angle + 180.0) / 360.0);
}

bool camera_motion_take(struct camera_motion* motion, const struct viewer_camera* camera) {
    if (motion->count > 0 && camera->segment == motion->newest.segment) {
        if (camera->level_time <= motion->newest.level_time) return false;
        motion->previous = motion->newest;
        motion->newest = *camera;
        motion->count = 2;
        return false;
    }
    motion->newest = *camera;
    motion->count = 1;
    return true;
}

struct view view_of_camera(const struct viewer_camera* camera) {
    struct view view = {{camera->position[0], camera->position[1], camera->position[2]}, {0, 0, 0}};
    (void)cdir_orientation_to_angles(camera->orientation, view.angles);
    return view;
}

/* For how many times the step from the previous to the newest camera the camera is moved on. */
static double steps_since(const struct camera_motion* motion, int32_t level_time) {
    if (motion->count < 2 || (motion->newest.flags & CDIR_CAMERA_HELD) != 0) return 0;
    const double step = (double)motion->newest.level_time - motion->previous.level_time;
    const double since = (double)level_time - motion->newest.level_time;
    return fmax(0, fmin(max_extrapolation, since)) / step;
}

static void keep_moving(struct view* view, const struct camera_motion* motion, double steps) {
    double move[3], squared = 0;
    for (int i = 0; i < 3; ++i) {
        move[i] = ((double)motion->newest.position[i] - motion->previous.position[i]) * steps;
        squared += move[i] * move[i];
    }
    const double length = sqrt(squared), limit = fmax(0, fmin(max_move, motion->newest.clearance - 1.0));
    const double part = length > limit ? limit / length : 1;
    for (int i = 0; i < 3; ++i) {
        view->position[i] = (float)(view->position[i] + part * move[i]);
    }
}

static void keep_turning(struct view* view, const struct camera_motion* motion, double steps) {
    const struct view previous = view_of_camera(&motion->previous);
    for (int i = 0; i < 2; ++i) {
        const double turn = wrapped((double)view->angles[i] - previous.angles[i]) * steps;
        view->angles[i] = (float)wrapped(view->angles[i] + turn);
    }
    view->angles[0] = (float)fmax(-max_pitch, fmin(max_pitch, view->angles[0]));
}

/* The unit vector from a position to a player's eye; false when the eye is too close. */
static bool direction_to_eye(double direction[3], const float position[3], const struct player_pose* player) {
    double squared = 0;
    for (int i = 0; i < 3; ++i) {
        direction[i] = (double)player->origin[i] + (i == 2 ? player->viewheight : 0) - position[i];
        squared += direction[i] * direction[i];
    }
    if (squared < min_eye_distance * min_eye_distance) return false;
    for (int i = 0; i < 3; ++i) {
        direction[i] /= sqrt(squared);
    }
    return true;
}

/* Turns pitch and yaw, not roll, so that direction `now` appears where direction `then` appeared. */
static void keep_in_place(struct view* view, const double then[3], const double now[3]) {
    const double pitch = view->angles[0] / degrees, yaw = view->angles[1] / degrees;
    /* `then` along the axes of the camera without its roll. */
    const double level = cos(yaw) * then[0] + sin(yaw) * then[1];
    const double left = -sin(yaw) * then[0] + cos(yaw) * then[1];
    const double forward = cos(pitch) * level - sin(pitch) * then[2];
    const double up = sin(pitch) * level + cos(pitch) * then[2];
    /* The new pitch raises (forward, up) to the height of `now`. When it cannot, the nearest. */
    const double radius = hypot(forward, up), elevation = atan2(up, forward);
    const double raised = asin(fmax(-1.0, fmin(1.0, radius > 0 ? now[2] / radius : 0)));
    const double ahead = level < 0 ? 180 / degrees - raised : raised;
    const double new_pitch = wrapped((elevation - ahead) * degrees);
    const double new_yaw = atan2(now[1], now[0]) - atan2(left, radius * cos(ahead));
    view->angles[0] = (float)fmax(-max_pitch, fmin(max_pitch, new_pitch));
    view->angles[1] = (float)wrapped(new_yaw * degrees);
}

static bool same_life(const struct player_pose* then, const struct player_pose* now) {
    return then != NULL && now != NULL && then->alive && now->alive &&
           then->teleport_bit == now->teleport_bit;
}

struct view predict_view(const struct camera_motion* motion, int32_t level_time,
                         const struct player_pose* then, const struct player_pose* now) {
    const uint32_t not_on_target = CDIR_CAMERA_SEARCHING | CDIR_CAMERA_TARGET_ABSENT;
    const uint32_t flags = motion->newest.flags;
    const double steps = steps_since(motion, level_time);
    struct view view = view_of_camera(&motion->newest);
    double direction_then[3], direction_now[3];
    if ((flags & CDIR_CAMERA_HELD) != 0) return view;
    if (steps > 0) keep_moving(&view, motion, steps);
    if ((flags & not_on_target) == 0 && same_life(then, now) &&
        direction_to_eye(direction_then, motion->newest.position, then) &&
        direction_to_eye(direction_now, view.position, now)) {
        keep_in_place(&view, direction_then, direction_now);
    } else if (steps > 0) {
        keep_turning(&view, motion, steps);
    }
    return view;
}
