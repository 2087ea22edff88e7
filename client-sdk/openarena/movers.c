/* SPDX-License-Identifier: GPL-2.0-or-later */
#include "movers.h"

#include <math.h>
#include <string.h>

#include "engine.h"

static struct mover_pose last_poses[max_entities]; /* model 0: none */

void movers_reset(void) {
    memset(last_poses, 0, sizeof last_poses);
}

static struct mover_pose mover_pose_of(const uint8_t* entity) {
    struct mover_pose pose = {.model = (int16_t)read_int(entity, ENTITY_MODEL_INDEX)};
    read_vector(pose.origin, entity, ENTITY_ORIGIN);
    read_vector(pose.angles, entity, ENTITY_ANGLES);
    return pose;
}

static bool same_pose(const struct mover_pose* a, const struct mover_pose* b) {
    return a->model == b->model && memcmp(a->origin, b->origin, sizeof a->origin) == 0 &&
           memcmp(a->angles, b->angles, sizeof a->angles) == 0;
}

static bool is_finite(const struct mover_pose* pose) {
    bool finite = true;
    for (int i = 0; i < 3; ++i) {
        finite = finite && isfinite(pose->origin[i]) && isfinite(pose->angles[i]);
    }
    return finite;
}

void movers_sample(struct server_frame* frame) {
    const int count = engine_entity_count();
    for (int number = max_slots; number < count && frame->mover_count < max_movers; ++number) {
        const uint8_t* entity = engine_entity(number);
        if (read_int(entity, ENTITY_TYPE) != ENTITY_TYPE_MOVER || read_int(entity, ENTITY_IN_USE) == 0 ||
            read_int(entity, ENTITY_BRUSH_MODEL) == 0) {
            continue;
        }
        const struct mover_pose pose = mover_pose_of(entity);
        if (same_pose(&pose, &last_poses[number]) || !is_finite(&pose)) continue;
        last_poses[number] = pose;
        frame->movers[frame->mover_count++] = pose;
    }
}
