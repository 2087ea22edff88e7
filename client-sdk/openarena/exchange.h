/* SPDX-License-Identifier: GPL-2.0-or-later */
/* Two rings between the game's thread and the worker: messages to the worker, reports to the game. */
#ifndef CAMERA_DIRECTOR_OPENARENA_EXCHANGE_H
#define CAMERA_DIRECTOR_OPENARENA_EXCHANGE_H

#include "frame.h"
#include "game/message_ring.h"
#include "settings.h"

#ifdef __cplusplus
extern "C" {
#endif

/* After a map has been loaded the server makes up for the time with many frames at once. */
enum { message_capacity = 256, report_capacity = 8 };

struct match_message {
    struct match_state state;
    char record[sizeof((struct settings*)0)->record]; /* of the settings */
};

struct message {
    struct message_header header;
    union {
        struct match_message match;
        struct server_frame frame;
    };
};

struct exchange;

/* Null when memory is short. */
struct exchange* exchange_create(void);
void exchange_destroy(struct exchange* exchange);

/* On the game's thread. Sends a copy; returns false when the ring is full. */
bool exchange_send_match(struct exchange* exchange, const struct match_message* match);
bool exchange_send_frame(struct exchange* exchange, const struct server_frame* frame);
bool exchange_send_end(struct exchange* exchange);
/* The newest report or null. It stays valid until the next call. */
const struct director_report* exchange_newest_report(struct exchange* exchange);

/* On the worker. The oldest message that has not been released, or null. */
const struct message* exchange_next_message(struct exchange* exchange);
void exchange_release_message(struct exchange* exchange);
/* Messages that wait. */
uint32_t exchange_backlog(const struct exchange* exchange);
/* Sends a copy; returns false when the ring is full. */
bool exchange_send_report(struct exchange* exchange, const struct director_report* report);

#ifdef __cplusplus
}
#endif

#endif
