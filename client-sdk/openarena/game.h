/* SPDX-License-Identifier: GPL-2.0-or-later */
/*
 * The real game module: found, loaded at the start of every life and unloaded at its end, so that it begins
 * each map with fresh memory as it does without this module.
 */
#ifndef CAMERA_DIRECTOR_OPENARENA_GAME_H
#define CAMERA_DIRECTOR_OPENARENA_GAME_H

#include <stdbool.h>
#include <stddef.h>

#include "engine.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef intptr_t (*game_main)(int, int, int, int, int, int, int, int, int, int, int, int, int);

/* Loads the module that the cvar director_game names, otherwise the one of the running game (fs_game) below
 * fs_basepath. Returns false and stores what to do about it in reason. `call` is what the game calls as its
 * engine. */
bool game_load(engine_call call, char* reason, size_t reason_size);
bool game_is_loaded(void);
const char* game_path(void);
void game_unload(void);

/* Calls the game's vmMain. 0 when none is loaded. */
intptr_t game_call(int command, const int arguments[game_call_arguments]);

/* Has the game execute a command as if the client in a slot had sent it. The words are its name and
 * arguments; count <= 4. */
void game_client_command(int slot, const char* const* words, int count);
/* While such a command is executed: the game asks its engine for the words. Returns false when none is. */
bool game_answer_argument(intptr_t number, const intptr_t arguments[engine_call_arguments], intptr_t* result);

#ifdef __cplusplus
}
#endif

#endif
