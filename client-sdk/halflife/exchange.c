#include "exchange.h"

#include <stdalign.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

enum { cache_line = 64, capacity = 64, reserved_places = 4 };

/* Counts of messages since the start, which wrap; a message's place is its number modulo the capacity. The
 * game's thread alone stores `sent`, the worker alone `released`. */
struct exchange {
    alignas(cache_line) _Atomic uint32_t sent;
    alignas(cache_line) _Atomic uint32_t released;
    alignas(cache_line) struct message messages[capacity];
};

struct exchange* exchange_create(void) {
    struct exchange* exchange = aligned_alloc(cache_line, sizeof(struct exchange));
    if (exchange != NULL) memset(exchange, 0, sizeof *exchange);
    return exchange;
}

void exchange_destroy(struct exchange* exchange) {
    free(exchange);
}

/* The place of the next message, unless fewer than `spare` others remain free; null then. */
static struct message* next_place(struct exchange* exchange, enum message_kind kind, uint32_t spare) {
    const uint32_t sent = atomic_load_explicit(&exchange->sent, memory_order_relaxed);
    const uint32_t released = atomic_load_explicit(&exchange->released, memory_order_acquire);
    if (sent - released + spare >= capacity) return NULL;
    struct message* message = &exchange->messages[sent % capacity];
    message->kind = kind;
    return message;
}

static void send_next(struct exchange* exchange) {
    const uint32_t sent = atomic_load_explicit(&exchange->sent, memory_order_relaxed);
    atomic_store_explicit(&exchange->sent, sent + 1, memory_order_release);
}

bool exchange_send_match(struct exchange* exchange, const struct match_state* match) {
    struct message* message = next_place(exchange, message_match, 1);
    if (message == NULL) return false;
    message->match = *match;
    send_next(exchange);
    return true;
}

bool exchange_send_frame(struct exchange* exchange, const struct server_frame* frame) {
    struct message* message = next_place(exchange, message_frame, reserved_places);
    if (message == NULL) return false;
    message->frame = *frame;
    send_next(exchange);
    return true;
}

bool exchange_send_end(struct exchange* exchange) {
    if (next_place(exchange, message_end, 0) == NULL) return false;
    send_next(exchange);
    return true;
}

const struct message* exchange_next(struct exchange* exchange) {
    const uint32_t released = atomic_load_explicit(&exchange->released, memory_order_relaxed);
    const uint32_t sent = atomic_load_explicit(&exchange->sent, memory_order_acquire);
    return sent == released ? NULL : &exchange->messages[released % capacity];
}

void exchange_release(struct exchange* exchange) {
    const uint32_t released = atomic_load_explicit(&exchange->released, memory_order_relaxed);
    atomic_store_explicit(&exchange->released, released + 1, memory_order_release);
}
