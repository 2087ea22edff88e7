/* A game module for tests: eight bots that run, one obituary on demand. What it does not do itself, tests
 * write into the arrays that it announces. */
#include <stdio.h>
#include <string.h>

#include "engine.h"

#define EXPORT __attribute__((visibility("default")))

enum { slots = 64, bots = 8, client_size = 900, entity_size = 816 };

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
    (void)a1, (void)a2, (void)a3, (void)a4, (void)a5, (void)a6, (void)a7, (void)a8, (void)a9, (void)a10;
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
        case GAME_CLIENT_DISCONNECT:
            engine(ENGINE_SET_CONFIGSTRING, (intptr_t)(CONFIGSTRING_PLAYERS + a0), (intptr_t)NULL);
            return 0;
        case GAME_CLIENT_COMMAND:
            print_command(a0);
            return 0;
        default:
            return 1000 * command + a11; /* shows that all arguments arrive */
    }
}
