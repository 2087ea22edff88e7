/* SPDX-License-Identifier: GPL-2.0-or-later */
/* The map's doors, lifts and other moving parts, where they were in the recorded match. */
#ifndef CAMERA_DIRECTOR_OPENARENA_FILM_SCENERY_H
#define CAMERA_DIRECTOR_OPENARENA_FILM_SCENERY_H

#include "take.h"

#ifdef __cplusplus
extern "C" {
#endif

/* After every frame of the game. The game's own ones keep those of its movements that are not recorded. */
void scenery_pose(const struct take* take, double time);

#ifdef __cplusplus
}
#endif

#endif
