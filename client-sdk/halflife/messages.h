/*
 * The events that the game announces to its clients in user messages, whose parts it passes to the engine one
 * by one. On the game's thread.
 */
#ifndef CAMERA_DIRECTOR_HALFLIFE_MESSAGES_H
#define CAMERA_DIRECTOR_HALFLIFE_MESSAGES_H

#include <stdbool.h>

#include "frame.h"

/* Forgets the message in progress and the rounds. find(name) is the number of a user message of the running
 * game; 0: the game has none of this name. */
void messages_reset(int (*find)(const char* name));

/* The parts of a message. `receiver` is the player that alone gets it, or CDIR_NO_PLAYER. */
void messages_begin(int type, uint32_t receiver);
void messages_byte(int value);
void messages_text(const char* text);
/* Returns true when the message was an event; kind, actor, subject, value and detail are set then. */
bool messages_end(struct game_event* event);

#endif
