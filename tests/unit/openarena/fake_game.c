/* A game module for tests: eight bots that run; whoever connects is a spectator. What it does not do itself,
 * tests write into the arrays that it announces. */
#include <stdio.h>
#include <string.h>

#include "engine.h"

#define EXPORT __attribute__((visibility("default")))

enum { slots = 64, bots = 8, client_size = 900, entity_size = 816 };
enum { call_engine_with_all = 700 }; /* a number of no call, to the game and to the engine */

static engine_call engine;
static uint8_t clients[slots * client_size];
static uint8_t entities[max_entities * entity_size];

EXPORT void dllEntry(engine_call call) {
    engine = call;
}

static void add_bot(int slot) {
    uint8_t* client = clients + (size_t)slot * client_size;
    char text[64];
    snprintf(text, sizeof text, "n\\Bot%d\\t\\0\\model\\sarge", slot);
    engine(ENGINE_SET_CONFIGSTRING, (intptr_t)(CONFIGSTRING_PLAYERS + slot), (intptr_t)text);
    write_int(client, PS_PERSISTANT + 4 * PERSISTANT_SPAWN_COUNT, 1);
    write_int(client, PS_STATS, 100);
    write_int(client, PS_VIEW_HEIGHT, 26);
    write_int(entities + (size_t)slot * entity_size, ENTITY_SERVER_FLAGS, ENTITY_BOT);
}

static void add_spectator(int slot) {
    uint8_t* client = clients + (size_t)slot * client_size;
    char text[64];
    snprintf(text, sizeof text, "n\\Viewer%d\\t\\3\\model\\sarge", slot);
    engine(ENGINE_SET_CONFIGSTRING, (intptr_t)(CONFIGSTRING_PLAYERS + slot), (intptr_t)text);
    write_int(client, PS_PERSISTANT + 4 * PERSISTANT_SPAWN_COUNT, 1);
    write_int(client, PS_PM_TYPE, PM_SPECTATOR);
    write_int(client, PS_CLIENT_NUMBER, slot);
}

/* Shows in its result that all arguments arrive in their order. */
static intptr_t digest(int command, const int arguments[game_call_arguments]) {
    uint32_t digest = (uint32_t)command;
    for (int i = 0; i < game_call_arguments; ++i) {
        digest = digest * 31 + (uint32_t)arguments[i];
    }
    return (intptr_t)digest;
}

static void run(int level_time) {
    char text[32] = "";
    for (int slot = 0; slot < bots; ++slot) {
        const float origin[3] = {(float)level_time, (float)slot, 24.0f};
        write_vector(clients + (size_t)slot * client_size, PS_ORIGIN, origin);
    }
    engine(ENGINE_CVAR_STRING, (intptr_t) "fake_drop", (intptr_t)text, (intptr_t)sizeof text);
    enum { drop_client = 16 };
    if (text[0] != '\0') engine(drop_client, (intptr_t)(text[0] - '0'), (intptr_t) "dropped");
}

static void print_command(int slot) {
    char line[256], word[64];
    int length = snprintf(line, sizeof line, "client %d:", slot);
    const int count = (int)engine(ENGINE_ARGC);
    for (int i = 0; i < count; ++i) {
        engine(ENGINE_ARGV, (intptr_t)i, (intptr_t)word, (intptr_t)sizeof word);
        length += snprintf(line + length, sizeof line - (size_t)length, " %s", word);
    }
    engine(ENGINE_PRINT, (intptr_t)line);
}

EXPORT intptr_t vmMain(int command, int a0, int a1, int a2, int a3, int a4, int a5, int a6, int a7, int a8,
                       int a9, int a10, int a11) {
    const int arguments[game_call_arguments] = {a0, a1, a2, a3, a4, a5, a6, a7, a8, a9, a10, a11};
    switch (command) {
        case GAME_INIT:
            engine(ENGINE_LOCATE_GAME_DATA, (intptr_t)entities, (intptr_t)200, (intptr_t)entity_size,
                   (intptr_t)clients, (intptr_t)client_size);
            for (int slot = 0; slot < bots; ++slot) {
                add_bot(slot);
            }
            return 0;
        case GAME_RUN_FRAME:
            run(a0);
            return 0;
        case GAME_CLIENT_CONNECT:
            add_spectator(a0);
            return 0;
        case GAME_CLIENT_DISCONNECT:
            engine(ENGINE_SET_CONFIGSTRING, (intptr_t)(CONFIGSTRING_PLAYERS + a0), (intptr_t)NULL);
            return 0;
        case GAME_CLIENT_COMMAND:
            print_command(a0);
            return 0;
        case call_engine_with_all:
            return engine(call_engine_with_all, (intptr_t)1, (intptr_t)2, (intptr_t)3, (intptr_t)4,
                          (intptr_t)5, (intptr_t)6, (intptr_t)7, (intptr_t)8, (intptr_t)9, (intptr_t)10,
                          (intptr_t)11, (intptr_t)12, (intptr_t)13, (intptr_t)14, (intptr_t)15);
        default:
            return digest(command, arguments);
    }
}
