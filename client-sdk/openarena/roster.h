/* SPDX-License-Identifier: GPL-2.0-or-later */
/* Who is in which slot, from the game's configstrings. */
#ifndef CAMERA_DIRECTOR_OPENARENA_ROSTER_H
#define CAMERA_DIRECTOR_OPENARENA_ROSTER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "game/match_state.h"

#ifdef __cplusplus
extern "C" {
#endif

void roster_reset(void);
/* Takes a configstring that the game sets; null = "". Ignores those of no player. */
void roster_take_configstring(int number, const char* text);
/* slot < max_slots. The team is the one that the player has chosen, a team_ value: a follower's own, not that
 * of the followed. The name is printable ASCII without colour codes. */
const struct match_player* roster_at(int slot);
/* Changes whenever an entry does. */
uint32_t roster_version(void);

/* A name, up to the next backslash, without colour codes and what is not printable ASCII. size > 0. */
void roster_copy_name(char* name, size_t size, const char* text);
/* The same of a player's configstring. */
struct match_player roster_parse(const char* configstring);

#ifdef __cplusplus
}
#endif

#endif
