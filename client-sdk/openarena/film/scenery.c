/* SPDX-License-Identifier: GPL-2.0-or-later */
#include "scenery.h"

#include "engine.h"
#include "frame.h"
#include "trajectory.h"

static bool is_mover(const uint8_t* entity) {
    return read_int(entity, ENTITY_IN_USE) != 0 && read_int(entity, ENTITY_TYPE) == ENTITY_TYPE_MOVER &&
           read_int(entity, ENTITY_BRUSH_MODEL) != 0;
}

/* The game takes its place from the trajectory, too: it stands still for it. */
static void write_pose(uint8_t* entity, const struct mover_pose* pose) {
    static const float no_motion[3] = {0, 0, 0};
    write_trajectory(entity, ENTITY_POSITION, pose->origin, no_motion);
    write_trajectory(entity, ENTITY_ROTATION, pose->angles, no_motion);
    write_vector(entity, ENTITY_ORIGIN, pose->origin);
    write_vector(entity, ENTITY_ANGLES, pose->angles);
    engine_link_entity(entity);
}

void scenery_pose(const struct take* take, double time) {
    const int count = engine_entity_count();
    for (int number = max_slots; number < count; ++number) {
        uint8_t* const entity = engine_mutable_entity(number);
        struct mover_pose pose;
        if (is_mover(entity) && take_mover(take, read_int(entity, ENTITY_MODEL_INDEX), time, &pose))
            write_pose(entity, &pose);
    }
}
