/* SPDX-License-Identifier: Apache-2.0 */
#include "game/message_ring.h"

static const uint32_t spare_places[] = {[message_match] = 1, [message_frame] = 4, [message_end] = 0};

void* message_ring_free_place(struct ring* ring, enum message_kind kind) {
    enum message_kind* message = ring_free_place(ring, spare_places[kind]);
    if (message != NULL) *message = kind;
    return message;
}
