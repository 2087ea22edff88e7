/* SPDX-License-Identifier: GPL-2.0-or-later */
/* Doors, lifts and the like: entities with a brush model of the map. */
#ifndef CAMERA_DIRECTOR_OPENARENA_MOVERS_H
#define CAMERA_DIRECTOR_OPENARENA_MOVERS_H

#include "frame.h"

void movers_reset(void);
/* Stores those that have moved since they were last stored: all of them in a life's first frame. When there
 * are more than max_movers, the rest follows in the next frames. */
void movers_sample(struct server_frame* frame);

#endif
