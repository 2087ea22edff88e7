/* The players as the game's entities show them. On the game's thread. */
#ifndef CAMERA_DIRECTOR_HALFLIFE_PLAYERS_H
#define CAMERA_DIRECTOR_HALFLIFE_PLAYERS_H

#include <stdbool.h>

#include "engine.h"
#include "frame.h"

/* A map's entities. */
struct entity_list {
    struct entity* first; /* the world; the players follow it */
    int count;
    int max_clients;
};

/* The id of the player whose entity this is; CDIR_NO_PLAYER: it is none, or lies outside the list. */
uint32_t players_id(const struct entity_list* list, const struct entity* entity);

/* Forgets the previous frame: its poses, and with reset also its health. */
void players_forget_poses(void);
void players_reset(void);

/* Writes who is in the game, by id. */
void players_identify(const struct entity_list* list, struct match_player players[match_max_players]);

/* Writes the poses of all players who are in the game. `time` is the engine's, in seconds. A pose has a
 * discontinuity when the player was not in the previous frame, has respawned, had the view set by the game,
 * or has moved further than velocity and lifts explain. */
void players_sample(const struct entity_list* list, double time, struct server_frame* frame);

/* Calls add(event) for every player who has lost health since the previous call. */
void players_damage(const struct entity_list* list, void (*add)(const struct game_event* event));

#endif
