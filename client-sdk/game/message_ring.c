/* SPDX-License-Identifier: Apache-2.0 */
#include "game/message_ring.h"

#include <string.h>

static const uint32_t spare_places[] = {[message_match] = 1, [message_frame] = 4, [message_end] = 0};

struct message_header* message_ring_free_place(struct ring* ring, enum message_kind kind) {
    struct message_header* message = ring_free_place(ring, spare_places[kind]);
    if (message != NULL) message->kind = kind;
    return message;
}

bool message_ring_send(struct ring* ring, enum message_kind kind, const void* body, size_t size) {
    struct message_header* message = message_ring_free_place(ring, kind);
    if (message == NULL) return false;
    if (size > 0) memcpy(message + 1, body, size);
    ring_send(ring);
    return true;
}
