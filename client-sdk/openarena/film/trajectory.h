/* SPDX-License-Identifier: GPL-2.0-or-later */
/* How an entity that is sent to clients moves: between its places in two snapshots, as they lie. */
#ifndef CAMERA_DIRECTOR_OPENARENA_FILM_TRAJECTORY_H
#define CAMERA_DIRECTOR_OPENARENA_FILM_TRAJECTORY_H

#include "engine.h"

/* trajectory_t in entityState_t. */
enum { ENTITY_POSITION = 12, ENTITY_ROTATION = 48 };
enum { TRAJECTORY_BASE = 12, TRAJECTORY_DELTA = 24, trajectory_interpolated = 1 };

static inline void write_trajectory(uint8_t* entity, size_t offset, const float base[3],
                                    const float delta[3]) {
    write_int(entity, offset, trajectory_interpolated);
    write_vector(entity, offset + TRAJECTORY_BASE, base);
    write_vector(entity, offset + TRAJECTORY_DELTA, delta);
}

#endif
