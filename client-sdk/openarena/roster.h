/* SPDX-License-Identifier: GPL-2.0-or-later */
/* Who is in which slot, from the game's configstrings. */
#ifndef CAMERA_DIRECTOR_OPENARENA_ROSTER_H
#define CAMERA_DIRECTOR_OPENARENA_ROSTER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

struct roster_entry {
    uint8_t in_use;
    uint8_t team;  /* team_ value that the player has chosen: a follower's own, not that of the followed */
    char name[36]; /* printable ASCII without colour codes */
};

void roster_reset(void);
/* Takes a configstring that the game sets; null = "". Ignores those of no player. */
void roster_take_configstring(int number, const char* text);
/* slot < max_slots. */
const struct roster_entry* roster_at(int slot);
/* Changes whenever an entry does. */
uint32_t roster_version(void);

/* A name, up to the next backslash, without colour codes and what is not printable ASCII. size > 0. */
void roster_copy_name(char* name, size_t size, const char* text);
/* Of a player's configstring. */
struct roster_entry roster_parse(const char* configstring);

#ifdef __cplusplus
}
#endif

#endif
