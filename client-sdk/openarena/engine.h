/* SPDX-License-Identifier: GPL-2.0-or-later */
/*
 * The interface between a Quake 3 engine and its game module on x86-64, as far as this module needs it: call
 * numbers, offsets and sizes of the shared structures in bytes, and the engine's services as C functions. To
 * be called on the game's thread only, and only while the engine is inside vmMain().
 */
#ifndef CAMERA_DIRECTOR_OPENARENA_ENGINE_H
#define CAMERA_DIRECTOR_OPENARENA_ENGINE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef intptr_t (*engine_call)(intptr_t number, ...);
enum { engine_call_arguments = 15, game_call_arguments = 12 };

/* Calls of the game to the engine. */
enum {
    ENGINE_PRINT = 0,
    ENGINE_ERROR = 1,
    ENGINE_CVAR_REGISTER = 3,
    ENGINE_CVAR_SET = 5,
    ENGINE_CVAR_INTEGER = 6,
    ENGINE_CVAR_STRING = 7,
    ENGINE_ARGC = 8,
    ENGINE_ARGV = 9,
    ENGINE_CONSOLE_COMMAND = 14,
    ENGINE_LOCATE_GAME_DATA = 15,
    ENGINE_SEND_SERVER_COMMAND = 17,
    ENGINE_SET_CONFIGSTRING = 18,
    ENGINE_GET_CONFIGSTRING = 19,
    ENGINE_LINK_ENTITY = 30,
    ENGINE_GET_USER_COMMAND = 36
};

/* Calls of the engine to the game: vmMain()'s first argument. */
enum {
    GAME_INIT = 0, /* level time, random seed, restart */
    GAME_SHUTDOWN = 1,
    GAME_CLIENT_CONNECT = 2, /* slot, first time, bot; returns a refusal's text or 0 */
    GAME_CLIENT_BEGIN = 3,
    GAME_CLIENT_USERINFO_CHANGED = 4,
    GAME_CLIENT_DISCONNECT = 5,
    GAME_CLIENT_COMMAND = 6,
    GAME_CLIENT_THINK = 7,
    GAME_RUN_FRAME = 8, /* level time in ms */
    GAME_CONSOLE_COMMAND = 9,
    GAME_RUN_BOTS = 10
};

/* Configstrings. */
enum {
    CONFIGSTRING_WARMUP = 5,
    CONFIGSTRING_RED_SCORE = 6,
    CONFIGSTRING_BLUE_SCORE = 7,
    CONFIGSTRING_INTERMISSION = 22,
    CONFIGSTRING_PLAYERS = 544, /* + slot: "n\NAME\t\TEAM..." */
    configstring_size = 1024
};

/* playerState_t: every client structure begins with one. */
enum {
    PS_COMMAND_TIME = 0,
    PS_PM_TYPE = 4,
    PS_PM_FLAGS = 12,
    PS_ORIGIN = 20,
    PS_VELOCITY = 32,
    PS_DELTA_ANGLES = 56, /* int[3]: view angles less the user command's, 65536 per turn */
    PS_GROUND_ENTITY = 68,
    PS_EFLAGS = 104,
    PS_CLIENT_NUMBER = 140,
    PS_WEAPON = 144,
    PS_VIEW_ANGLES = 152,
    PS_VIEW_HEIGHT = 164,
    PS_DAMAGE_EVENT = 168,
    PS_DAMAGE_COUNT = 180,
    PS_STATS = 184,      /* int[16] */
    PS_PERSISTANT = 248, /* int[16] */
    PS_POWERUPS = 312,   /* int[16]: level times at which they end */
    PS_PING = 452,
    player_state_size = 468
};

/* Values of PS_PM_TYPE. */
enum { PM_NORMAL = 0, PM_SPECTATOR = 2, PM_DEAD = 3, PM_INTERMISSION = 5 };
/* Bits of PS_PM_FLAGS and PS_EFLAGS. */
enum { PM_FLAG_FOLLOW = 4096, EFLAG_TELEPORT = 4 };
/* Indices into PS_STATS. */
enum { STAT_HEALTH = 0, STAT_ARMOR = 4, STAT_MAX_HEALTH = 7 };
/* Indices into PS_PERSISTANT. */
enum {
    PERSISTANT_SCORE = 0,
    PERSISTANT_TEAM = 3,
    PERSISTANT_SPAWN_COUNT = 4,
    PERSISTANT_ATTACKER = 6,
    PERSISTANT_IMPRESSIVE = 9,
    PERSISTANT_EXCELLENT = 10,
    PERSISTANT_DEFEND = 11,
    PERSISTANT_ASSIST = 12,
    PERSISTANT_GAUNTLET = 13,
    PERSISTANT_CAPTURES = 14
};

/* entityState_t and entityShared_t: every entity structure begins with them. */
enum {
    ENTITY_TYPE = 4,
    ENTITY_OTHER = 140,
    ENTITY_OTHER2 = 144,
    ENTITY_MODEL_INDEX = 160,
    ENTITY_EVENT_PARAMETER = 184,
    ENTITY_SERVER_FLAGS = 424,
    ENTITY_BRUSH_MODEL = 432,
    ENTITY_ORIGIN = 488,
    ENTITY_ANGLES = 500,
    ENTITY_IN_USE = 528,
    entity_shared_size = 532
};
enum {
    ENTITY_TYPE_MOVER = 4,
    ENTITY_TYPE_OBITUARY = 73, /* temporary: 13 + event 60 */
    ENTITY_BOT = 8,            /* bit of ENTITY_SERVER_FLAGS */
    ENTITY_NUMBER_WORLD = 1022,
    max_entities = 1024
};

static inline int32_t read_int(const uint8_t* structure, size_t offset) {
    int32_t value;
    memcpy(&value, structure + offset, sizeof value);
    return value;
}
static inline int32_t read_element(const uint8_t* structure, size_t array, size_t index) {
    return read_int(structure, array + 4 * index);
}
static inline float read_float(const uint8_t* structure, size_t offset) {
    float value;
    memcpy(&value, structure + offset, sizeof value);
    return value;
}
static inline void read_vector(float vector[3], const uint8_t* structure, size_t offset) {
    memcpy(vector, structure + offset, 3 * sizeof *vector);
}
static inline void write_int(uint8_t* structure, size_t offset, int32_t value) {
    memcpy(structure + offset, &value, sizeof value);
}
static inline void write_vector(uint8_t* structure, size_t offset, const float vector[3]) {
    memcpy(structure + offset, vector, 3 * sizeof *vector);
}

/* Sets what the functions below call. */
void engine_attach(engine_call call);

/* The game's arrays, as it announces them with ENGINE_LOCATE_GAME_DATA. Structures that are too small for the
 * offsets above and counts out of range are refused: there are no clients and entities then. */
void engine_locate(const intptr_t arguments[engine_call_arguments]);
void engine_forget_game_data(void);

/* A client's playerState_t, or null before the game has announced its clients. slot < max_slots. */
uint8_t* engine_player_state(int slot);
/* The number of entities in use or used before; 0 before the game has announced them. */
int engine_entity_count(void);
/* number < engine_entity_count(). */
const uint8_t* engine_entity(int number);
uint8_t* engine_mutable_entity(int number);
/* Has the engine take up an entity's changed place. */
void engine_link_entity(uint8_t* entity);

/* Prints on the server's console. */
void engine_print(const char* format, ...) __attribute__((format(printf, 1, 2)));
/* Prints one line on the console of a client, or of the server with slot -1. Characters that would end the
 * engine's command or upset a terminal are replaced. */
void engine_print_line(int slot, const char* format, ...) __attribute__((format(printf, 2, 3)));
/* Ends the game with a message; the server program goes on without a map. Does not return to its caller. */
void engine_error(const char* format, ...) __attribute__((format(printf, 1, 2)));

enum cvar_access {
    cvar_open = 0,
    cvar_set_at_start = 16 /* no longer once it is registered, from no console */
};
void engine_cvar_register(const char* name, const char* value, enum cvar_access access);
void engine_cvar_set(const char* name, const char* value);
int engine_cvar_integer(const char* name);
void engine_cvar_string(const char* name, char* text, size_t size);

/* Has the server execute a line of its console at once: it calls vmMain() again meanwhile. */
void engine_enter_command(const char* line);

/* Of the command in progress, 0 = its name. Out of range: an empty string. */
int engine_argument_count(void);
void engine_argument(int index, char* text, size_t size);

/* Sends a command such as `print "text\n"` to one client, or to all with slot -1. */
void engine_send_command(int slot, const char* command);
void engine_configstring(int number, char* text, size_t size);

/* The view angles of the newest command that a client has sent: pitch, yaw, roll, 65536 per turn. */
void engine_user_angles(int slot, int32_t angles[3]);

#ifdef __cplusplus
}
#endif

#endif
