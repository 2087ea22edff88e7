/*
 * A bounded ring of messages from the game's thread to the worker. No call waits, locks, allocates or enters
 * the kernel, except for create and destroy.
 */
#ifndef CAMERA_DIRECTOR_HALFLIFE_EXCHANGE_H
#define CAMERA_DIRECTOR_HALFLIFE_EXCHANGE_H

#include <stdbool.h>

#include "frame.h"

enum message_kind {
    message_match,
    message_frame,
    message_end /* of the life: no frame follows */
};

struct message {
    enum message_kind kind;
    union {
        struct match_state match;
        struct server_frame frame;
    };
};

struct exchange;

struct exchange* exchange_create(void); /* null when memory is short */
void exchange_destroy(struct exchange* exchange);

/* On the game's thread. Sends a copy; returns false when the ring is full. Frames leave room to the others.
 */
bool exchange_send_match(struct exchange* exchange, const struct match_state* match);
bool exchange_send_frame(struct exchange* exchange, const struct server_frame* frame);
bool exchange_send_end(struct exchange* exchange);

/* On the worker. The oldest message that has not been released; null when there is none. */
const struct message* exchange_next(struct exchange* exchange);
void exchange_release(struct exchange* exchange);

#endif
