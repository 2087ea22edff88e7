/* SPDX-License-Identifier: Apache-2.0 */
/* A ring of messages from the game's thread to the worker. A message is a struct of a message_header and a
 * body that depends on its kind. */
#ifndef CAMERA_DIRECTOR_GAME_MESSAGE_RING_H
#define CAMERA_DIRECTOR_GAME_MESSAGE_RING_H

#include <stdalign.h>
#include <stdbool.h>

#include "game/ring.h"

#ifdef __cplusplus
extern "C" {
#endif

enum message_kind {
    message_match, /* of a life of the game: before its first frame, and when something of it changes */
    message_frame,
    message_end /* of the life: no frame follows, and there is no body */
};

/* As large as it is aligned: every body begins right behind it. */
struct message_header {
    alignas(max_align_t) enum message_kind kind;
};

/* As ring_free_place(), with the kind filled in. A frame leaves room to the others, and a match to an end:
 * those must not be lost behind frames that nobody takes. */
struct message_header* message_ring_free_place(struct ring* ring, enum message_kind kind);
/* Sends a message with a copy of the body's `size` bytes, which fit into the ring's places. Returns false
 * when the ring is too full for its kind. */
bool message_ring_send(struct ring* ring, enum message_kind kind, const void* body, size_t size);

#ifdef __cplusplus
}
#endif

#endif
