/*
 * The game's thread: samples the running map and sends it to the worker. Makes no system call after a map has
 * begun.
 */
#ifndef CAMERA_DIRECTOR_HALFLIFE_GAME_H
#define CAMERA_DIRECTOR_HALFLIFE_GAME_H

#include "engine.h"
#include "frame.h"

/* A map has begun. find_message: see messages_reset(). */
void game_begin_map(struct entity* entities, int count, int max_clients,
                    int (*find_message)(const char* name));
void game_run_frame(void);
void game_end_map(void);

/* The id of the player whose entity this is, or CDIR_NO_PLAYER. */
uint32_t game_player_id(const struct entity* entity);
/* Adds an event to the next frame. */
void game_add_event(const struct game_event* event);

/* Prints what the plugin does, one fact a line. */
void game_print_status(void);

/* Stops the worker and leaves the network. */
void game_close(void);

#endif
