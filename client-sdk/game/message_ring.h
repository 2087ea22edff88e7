/* SPDX-License-Identifier: Apache-2.0 */
/* A ring of messages from the game's thread to the worker. A message is a struct that begins with its kind.
 */
#ifndef CAMERA_DIRECTOR_GAME_MESSAGE_RING_H
#define CAMERA_DIRECTOR_GAME_MESSAGE_RING_H

#include "game/ring.h"

#ifdef __cplusplus
extern "C" {
#endif

enum message_kind {
    message_match, /* of a life of the game: before its first frame, and when something of it changes */
    message_frame,
    message_end /* of the life: no frame follows */
};

/* As ring_free_place(), with the kind filled in. A frame leaves room to the others, and a match to an end:
 * those must not be lost behind frames that nobody takes. */
void* message_ring_free_place(struct ring* ring, enum message_kind kind);

#ifdef __cplusplus
}
#endif

#endif
