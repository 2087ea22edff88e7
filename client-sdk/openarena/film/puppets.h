/* SPDX-License-Identifier: GPL-2.0-or-later */
/* The game's bots as the bodies of recorded players: they stand still for the game and are sent to clients
 * where the players were. */
#ifndef CAMERA_DIRECTOR_OPENARENA_FILM_PUPPETS_H
#define CAMERA_DIRECTOR_OPENARENA_FILM_PUPPETS_H

#include "take.h"

/* Has the server add a bot for a player of the take who has none. Returns true when all have one. Bots can
 * enter only after the game's code for bots has loaded the map; it need not run after the first one. */
bool puppets_enter(const struct take* take);
bool puppets_can_stand(void);
/* After every frame of the game, which puts the bots where they stand. */
void puppets_pose(const struct take* take, double time);

#endif
