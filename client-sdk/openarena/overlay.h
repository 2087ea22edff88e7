/* SPDX-License-Identifier: GPL-2.0-or-later */
/*
 * What the engine sends a spectator instead of the game's own playerState. It is on only while no code of the
 * game runs: the game never sees it.
 */
#ifndef CAMERA_DIRECTOR_OPENARENA_OVERLAY_H
#define CAMERA_DIRECTOR_OPENARENA_OVERLAY_H

#include <stdbool.h>

#include "engine.h"
#include "view_prediction.h"

#ifdef __cplusplus
extern "C" {
#endif

/* One slot's. All zero at first. */
struct overlay {
    bool active;          /* a camera is sent, otherwise the game's own state */
    bool on;              /* own holds the game's state, the game's place holds the camera */
    int32_t teleport_bit; /* as the client is shown it */
    uint8_t camera[player_state_size], own[player_state_size];
};

/* What is sent from the next overlay_put_on() on: a view. cut: it does not continue the previous one; so does
 * none that follows the game's own view. */
void overlay_show_camera(struct overlay* overlay, int slot, int32_t level_time, const struct view* view,
                         bool cut);
/* The game's own state of a spectator. Toggles its teleport bit where the client would blend the camera into
 * it. */
void overlay_show_own(struct overlay* overlay, int slot, uint8_t* own);
/* Before the game spawns the client, which toggles the teleport bit of the game's state: makes that a cut for
 * a client that is shown a camera. */
void overlay_prepare_spawn(const struct overlay* overlay, uint8_t* own);

/* Put on and take off a client's playerState; a second call in a row does nothing. No player's state is
 * touched, and no intermission is covered. Taking off restores every byte except the ping, which the engine
 * measures meanwhile. */
void overlay_put_on(struct overlay* overlay, uint8_t* state);
void overlay_take_off(struct overlay* overlay, uint8_t* state);

#ifdef __cplusplus
}
#endif

#endif
