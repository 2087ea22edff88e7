/* SPDX-License-Identifier: GPL-2.0-or-later */
/* The players' poses, from their playerStates. */
#ifndef CAMERA_DIRECTOR_OPENARENA_POSES_H
#define CAMERA_DIRECTOR_OPENARENA_POSES_H

#include <stdbool.h>

#include "frame.h"
#include "roster.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Of all slots. On the game's thread, while the playerStates are the game's own. */
void poses_sample(struct player_pose poses[max_slots]);

/* Of one playerState_t. Poses with numbers that are not finite count as not in the game. */
struct player_pose pose_of(const uint8_t* player_state, const struct match_player* entry, bool bot);

/* For the director: the eye's position, and whether the player jumped between two frames: appeared,
 * respawned, teleported. */
void pose_eye(float eye[3], const struct player_pose* pose);
bool pose_jumped(const struct player_pose* before, const struct player_pose* now);

#ifdef __cplusplus
}
#endif

#endif
