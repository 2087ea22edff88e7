/* SPDX-License-Identifier: GPL-2.0-or-later */
#include "movers.h"

#include <math.h>
#include <string.h>

#include "engine.h"

static struct mover_pose last_poses[max_entities]; /* model 0: none */

void movers_reset(void) {
    memset(last_poses, 0, sizeof last_poses);
}

static struct mover_pose pose_of(const uint8_t* entity) {
    struct mover_pose pose;
    memset(&pose, 0, sizeof pose); /* compared as bytes */
    pose.model = (int16_t)read_int(entity, ENTITY_MODEL_INDEX);
    read_vector(pose.origin, entity, ENTITY_ORIGIN);
    read_vector(pose.angles, entity, ENTITY_ANGLES);
    return pose;
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
        const struct mover_pose pose = pose_of(entity);
        if (memcmp(&pose, &last_poses[number], sizeof pose) == 0 || !is_finite(&pose)) continue;
        last_poses[number] = pose;
        frame->movers[frame->mover_count++] = pose;
    }
}
