/* SPDX-License-Identifier: GPL-2.0-or-later */
#include "exchange.h"

#include <stdalign.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

enum { cache_line = 64, reserved_messages = 4 };

/* Positions count elements since the start and never wrap; an element's place is its position modulo the
 * capacity. The writer alone stores `written`, the reader alone `released`. */
struct positions {
    alignas(cache_line) _Atomic uint64_t written;
    alignas(cache_line) _Atomic uint64_t released;
};

struct exchange {
    struct positions message_positions, report_positions;
    struct message messages[message_capacity];
    struct director_report reports[report_capacity];
};

static uint64_t used(const struct positions* positions) {
    /* The order of the loads keeps the difference from becoming negative. */
    const uint64_t released = atomic_load_explicit(&positions->released, memory_order_acquire);
    return atomic_load_explicit(&positions->written, memory_order_acquire) - released;
}

static uint64_t written(const struct positions* positions) {
    return atomic_load_explicit(&positions->written, memory_order_relaxed);
}

static uint64_t released(const struct positions* positions) {
    return atomic_load_explicit(&positions->released, memory_order_relaxed);
}

static void publish(struct positions* positions) {
    atomic_store_explicit(&positions->written, written(positions) + 1, memory_order_release);
}

static void release(struct positions* positions, uint64_t count) {
    atomic_store_explicit(&positions->released, released(positions) + count, memory_order_release);
}

struct exchange* exchange_create(void) {
    struct exchange* exchange = aligned_alloc(cache_line, sizeof(struct exchange));
    if (exchange != NULL) memset(exchange, 0, sizeof *exchange);
    return exchange;
}

void exchange_destroy(struct exchange* exchange) {
    free(exchange);
}

static struct message* new_message(struct exchange* exchange, enum message_kind kind, uint32_t reserved) {
    const struct positions* positions = &exchange->message_positions;
    if (used(positions) + reserved >= message_capacity) return NULL;
    struct message* message = &exchange->messages[written(positions) % message_capacity];
    message->kind = kind;
    return message;
}

bool exchange_send_match(struct exchange* exchange, const struct match_state* match) {
    struct message* message = new_message(exchange, message_match, 1);
    if (message == NULL) return false;
    message->match = *match;
    publish(&exchange->message_positions);
    return true;
}

bool exchange_send_frame(struct exchange* exchange, const struct server_frame* frame) {
    struct message* message = new_message(exchange, message_frame, reserved_messages);
    if (message == NULL) return false;
    memcpy(&message->frame, frame, offsetof(struct server_frame, events));
    memcpy(message->frame.events, frame->events, frame->event_count * sizeof *frame->events);
    memcpy(message->frame.movers, frame->movers, frame->mover_count * sizeof *frame->movers);
    publish(&exchange->message_positions);
    return true;
}

bool exchange_send_end(struct exchange* exchange) {
    if (new_message(exchange, message_end, 0) == NULL) return false;
    publish(&exchange->message_positions);
    return true;
}

const struct director_report* exchange_newest_report(struct exchange* exchange) {
    struct positions* positions = &exchange->report_positions;
    const uint64_t count = used(positions);
    if (count == 0) return NULL;
    release(positions, count - 1);
    return &exchange->reports[released(positions) % report_capacity];
}

const struct message* exchange_next_message(struct exchange* exchange) {
    const struct positions* positions = &exchange->message_positions;
    return used(positions) == 0 ? NULL : &exchange->messages[released(positions) % message_capacity];
}

void exchange_release_message(struct exchange* exchange) {
    release(&exchange->message_positions, 1);
}

uint32_t exchange_backlog(const struct exchange* exchange) {
    return (uint32_t)used(&exchange->message_positions);
}

bool exchange_send_report(struct exchange* exchange, const struct director_report* report) {
    struct positions* positions = &exchange->report_positions;
    if (used(positions) == report_capacity) return false;
    exchange->reports[written(positions) % report_capacity] = *report;
    publish(positions);
    return true;
}
