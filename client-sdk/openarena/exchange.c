/* SPDX-License-Identifier: GPL-2.0-or-later */
#include "exchange.h"

#include <stdlib.h>
#include <string.h>

struct exchange {
    struct ring *messages, *reports;
};

struct exchange* exchange_create(void) {
    struct exchange* exchange = malloc(sizeof *exchange);
    if (exchange == NULL) return NULL;
    exchange->messages = ring_create(message_capacity, sizeof(struct message));
    exchange->reports = ring_create(report_capacity, sizeof(struct director_report));
    if (exchange->messages != NULL && exchange->reports != NULL) return exchange;
    exchange_destroy(exchange);
    return NULL;
}

void exchange_destroy(struct exchange* exchange) {
    if (exchange == NULL) return;
    ring_destroy(exchange->messages);
    ring_destroy(exchange->reports);
    free(exchange);
}

bool exchange_send_match(struct exchange* exchange, const struct match_message* match) {
    return message_ring_send(exchange->messages, message_match, match, sizeof *match);
}

/* Copies only the events and movers that there are. */
bool exchange_send_frame(struct exchange* exchange, const struct server_frame* frame) {
    struct message* message = (struct message*)message_ring_free_place(exchange->messages, message_frame);
    if (message == NULL) return false;
    memcpy(&message->frame, frame, offsetof(struct server_frame, events));
    memcpy(message->frame.events, frame->events, frame->event_count * sizeof *frame->events);
    memcpy(message->frame.movers, frame->movers, frame->mover_count * sizeof *frame->movers);
    ring_send(exchange->messages);
    return true;
}

bool exchange_send_end(struct exchange* exchange) {
    return message_ring_send(exchange->messages, message_end, NULL, 0);
}

const struct director_report* exchange_newest_report(struct exchange* exchange) {
    return ring_newest(exchange->reports);
}

const struct message* exchange_next_message(struct exchange* exchange) {
    return ring_oldest(exchange->messages);
}

void exchange_release_message(struct exchange* exchange) {
    ring_release(exchange->messages);
}

uint32_t exchange_backlog(const struct exchange* exchange) {
    return ring_used(exchange->messages);
}

bool exchange_send_report(struct exchange* exchange, const struct director_report* report) {
    struct director_report* place = ring_free_place(exchange->reports, 0);
    if (place == NULL) return false;
    *place = *report;
    ring_send(exchange->reports);
    return true;
}
