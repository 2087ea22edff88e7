/* The ring of messages from the game's thread to the worker. */
#ifndef CAMERA_DIRECTOR_HALFLIFE_EXCHANGE_H
#define CAMERA_DIRECTOR_HALFLIFE_EXCHANGE_H

#include <stdbool.h>

#include "frame.h"
#include "game/message_ring.h"

struct message {
    enum message_kind kind;
    union {
        struct match_state match;
        struct server_frame frame;
    };
};

/* Null when memory is short. Destroyed by ring_destroy(). */
struct ring* exchange_create(void);

/* On the game's thread. Sends a copy; returns false when the ring is full. */
bool exchange_send_match(struct ring* exchange, const struct match_state* match);
bool exchange_send_frame(struct ring* exchange, const struct server_frame* frame);
bool exchange_send_end(struct ring* exchange);

/* On the worker. The oldest message that has not been released; null when there is none. */
const struct message* exchange_next(const struct ring* exchange);

#endif
