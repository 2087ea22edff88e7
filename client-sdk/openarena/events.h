/* SPDX-License-Identifier: GPL-2.0-or-later */
/* What happened since the previous frame. */
#ifndef CAMERA_DIRECTOR_OPENARENA_EVENTS_H
#define CAMERA_DIRECTOR_OPENARENA_EVENTS_H

#include <stdbool.h>

#include "frame.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { power_up_count = 16, award_count = 5 };

enum game_kind { game_of_players, game_of_teams, game_with_rounds /* in which the dead wait for the next */ };

/* Of a value of the cvar g_gametype. */
enum game_kind events_game_kind(int game_type);

/* Forgets the previous frame. */
void events_reset(enum game_kind kind);
/* Takes a configstring that the game sets; null = "". */
void events_take_configstring(int number, const char* text);
/* Stores the events of a frame whose poses are sampled already. What exceeds max_events is lost. */
void events_sample(struct server_frame* frame);

/* What of a playerState_t tells of events. */
struct vitals {
    uint8_t present; /* in the game and no spectator; all else is 0 otherwise */
    uint8_t alive;
    int32_t health, armor;
    int32_t spawn_count;
    int32_t damage_event; /* counts frames with damage */
    int32_t damage;       /* in the last such frame */
    int32_t attacker;     /* entity number */
    int32_t captures;
    int32_t awards[award_count];
    int32_t power_ups[power_up_count]; /* level times at which they end; flags: not 0 */
};

struct vitals vitals_of(const uint8_t* player_state, const struct player_pose* pose);

/* Appends what happened to the player in a slot between two frames to `count` events; returns the new count,
 * at most max_events. */
uint32_t append_player_events(struct game_event events[max_events], uint32_t count, uint8_t slot,
                              const struct vitals* before, const struct vitals* now);

/* The name of a means of death, such as "MOD_ROCKET"; "MOD_UNKNOWN" for numbers that have none. */
const char* means_name(int means);

#ifdef __cplusplus
}
#endif

#endif
