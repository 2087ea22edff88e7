#include "exchange.h"

enum { capacity = 64 };

struct ring* exchange_create(void) {
    return ring_create(capacity, sizeof(struct message));
}

bool exchange_send_match(struct ring* exchange, const struct match_state* match) {
    struct message* message = message_ring_free_place(exchange, message_match);
    if (message == NULL) return false;
    message->match = *match;
    ring_send(exchange);
    return true;
}

bool exchange_send_frame(struct ring* exchange, const struct server_frame* frame) {
    struct message* message = message_ring_free_place(exchange, message_frame);
    if (message == NULL) return false;
    message->frame = *frame;
    ring_send(exchange);
    return true;
}

bool exchange_send_end(struct ring* exchange) {
    if (message_ring_free_place(exchange, message_end) == NULL) return false;
    ring_send(exchange);
    return true;
}

const struct message* exchange_next(const struct ring* exchange) {
    return ring_oldest(exchange);
}
