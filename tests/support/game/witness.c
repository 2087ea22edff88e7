/* SPDX-License-Identifier: GPL-2.0-or-later */
/* A game module for tests that stands between the engine and another game module: it forwards every call and
 * logs, after every server frame, the client states that the engine is about to send, and the time that the
 * module took.
 *
 * Beside the library PATH lie PATH.next, the path of the module to forward to, and PATH.log, to which it
 * appends struct witness_record. Two copies, one on either side of a module, measure what that module adds.
 */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "support/game/records.h"

#define EXPORTED __attribute__((visibility("default")))

typedef intptr_t (*engine_call)(intptr_t, ...);
typedef intptr_t (*module_main)(int, int, int, int, int, int, int, int, int, int, int, int, int);
typedef void (*module_entry)(engine_call);

enum { call_locate_game_data = 15, call_set_configstring = 18, player_strings = 544, engine_arguments = 15 };
enum { main_init = 0, main_shutdown = 1, main_run_frame = 8 };
/* Offsets in bytes. */
enum {
    player_pm_type = 4,
    player_pm_flags = 12,
    player_origin = 20,
    player_flags = 104,
    player_client_num = 140,
    player_angles = 152,
    player_view_height = 164,
    player_health = 184,
    player_spawn_count = 264,
    entity_type = 4,
    entity_flags = 8,
    entity_base = 24,
    entity_velocity = 36,
    entity_slot = 168,
    entity_powerups = 188,
    entity_linked = 416,
    entity_server_flags = 424,
    server_flag_bot = 8
};

static void* next_module;
static module_main next_main;
static engine_call engine;
static FILE* log_file;
static const char *entities, *clients;
static intptr_t entity_count, entity_size, client_size;
static int connected[witness_slots], teams[witness_slots];
static struct witness_record frame; /* waits for the call after it, which says whether it was sent */
static int frame_waits, depth;
static int64_t between_ns, whole_between_ns;

static int64_t now(void) {
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (int64_t)time.tv_sec * 1000000000 + time.tv_nsec;
}

static int32_t int_at(const char* base, int offset) {
    int32_t value;
    memcpy(&value, base + offset, sizeof value);
    return value;
}

static void write_record(const struct witness_record* record) {
    if (!log_file) return;
    fwrite(record, sizeof *record, 1, log_file);
    fflush(log_file);
}

static void write_mark(int kind, int level_time) {
    struct witness_record mark = {.kind = kind, .level_time = level_time, .time = now()};
    write_record(&mark);
}

static intptr_t forward_to_engine(intptr_t number, ...) {
    intptr_t a[engine_arguments];
    va_list arguments;
    va_start(arguments, number);
    for (int i = 0; i < engine_arguments; ++i)
        a[i] = va_arg(arguments, intptr_t);
    va_end(arguments);
    if (number == call_locate_game_data) {
        entities = (const char*)a[0];
        entity_count = a[1];
        entity_size = a[2];
        clients = (const char*)a[3];
        client_size = a[4];
    }
    if (number == call_set_configstring && a[0] >= player_strings && a[0] < player_strings + witness_slots) {
        const char* value = a[1] ? (const char*)a[1] : "";
        const char* team = strstr(value, "\\t\\");
        connected[a[0] - player_strings] = *value != '\0';
        teams[a[0] - player_strings] = team ? atoi(team + 3) : -1;
    }
    return engine(number, a[0], a[1], a[2], a[3], a[4], a[5], a[6], a[7], a[8], a[9], a[10], a[11], a[12],
                  a[13], a[14]);
}

static void sample(struct witness_player* player, int slot) {
    const char* state = clients + slot * client_size;
    const char* entity = entities + slot * entity_size;
    memset(player, 0, sizeof *player);
    player->connected = connected[slot];
    player->team = teams[slot];
    player->bot = (int_at(entity, entity_server_flags) & server_flag_bot) != 0;
    player->in_game = int_at(state, player_spawn_count) > 0;
    player->pm_type = int_at(state, player_pm_type);
    player->pm_flags = int_at(state, player_pm_flags);
    player->view_flags = int_at(state, player_flags);
    player->client_num = int_at(state, player_client_num);
    player->view_height = int_at(state, player_view_height);
    player->health = int_at(state, player_health);
    memcpy(player->origin, state + player_origin, sizeof player->origin);
    memcpy(player->angles, state + player_angles, sizeof player->angles);
    player->entity_flags = int_at(entity, entity_flags);
    player->powerups = int_at(entity, entity_powerups);
    memcpy(player->base, entity + entity_base, sizeof player->base);
    memcpy(player->velocity, entity + entity_velocity, sizeof player->velocity);
}

static void sample_corpses(void) {
    enum { first_entity = 64, type_player = 1 };
    for (int i = first_entity; i < entity_count && frame.corpse_count < witness_corpses; ++i) {
        const char* entity = entities + i * entity_size;
        if (int_at(entity, entity_type) != type_player || !int_at(entity, entity_linked)) continue;
        struct witness_corpse* corpse = &frame.corpses[frame.corpse_count++];
        corpse->slot = int_at(entity, entity_slot);
        memcpy(corpse->base, entity + entity_base, sizeof corpse->base);
    }
}

static void sample_frame(int level_time, int64_t begin, int64_t end) {
    memset(&frame, 0, sizeof frame);
    frame.kind = witness_ran_frame;
    frame.level_time = level_time;
    frame.time = end;
    frame.frame_ns = end - begin;
    frame.between_ns = between_ns;
    frame.whole_between_ns = whole_between_ns;
    between_ns = whole_between_ns = 0;
    for (int slot = 0; clients && slot < witness_slots; ++slot)
        sample(&frame.players[slot], slot);
    if (entities) sample_corpses();
    frame_waits = 1;
}

/* The server sends after its frames, unless it runs two of them at once. */
static void finish_frame(int next_call) {
    if (!frame_waits) return;
    frame.sent = next_call != main_run_frame;
    write_record(&frame);
    frame_waits = 0;
}

EXPORTED void dllEntry(engine_call call) {
    Dl_info self;
    module_entry next_entry;
    char name[4096], next[4096] = "";
    engine = call;
    if (!dladdr(&engine, &self)) return;
    snprintf(name, sizeof name, "%s.next", self.dli_fname);
    FILE* file = fopen(name, "r");
    if (!file || !fgets(next, sizeof next, file)) fprintf(stderr, "witness: cannot read %s\n", name);
    if (file) fclose(file);
    next[strcspn(next, "\n")] = '\0';
    snprintf(name, sizeof name, "%s.log", self.dli_fname);
    log_file = fopen(name, "ab");
    next_module = dlopen(next, RTLD_NOW | RTLD_LOCAL);
    if (!next_module) {
        fprintf(stderr, "witness: %s\n", dlerror());
        return;
    }
    *(void**)&next_main = dlsym(next_module, "vmMain");
    *(void**)&next_entry = dlsym(next_module, "dllEntry");
    if (next_entry) next_entry(forward_to_engine);
}

EXPORTED intptr_t vmMain(int call, int a0, int a1, int a2, int a3, int a4, int a5, int a6, int a7, int a8,
                         int a9, int a10, int a11) {
    if (!next_main) return -1;
    const int64_t entry = now();
    if (depth == 0) finish_frame(call);
    if (call == main_init) {
        memset(connected, 0, sizeof connected);
        write_mark(witness_starts, a0);
    }
    ++depth;
    const int64_t begin = now();
    const intptr_t result = next_main(call, a0, a1, a2, a3, a4, a5, a6, a7, a8, a9, a10, a11);
    const int64_t end = now();
    --depth;
    if (call == main_shutdown) write_mark(witness_ends, 0);
    if (call == main_run_frame) {
        sample_frame(a0, begin, end);
        frame.whole_frame_ns = now() - entry;
    } else if (depth == 0) {
        between_ns += end - begin;
        whole_between_ns += now() - entry;
    }
    return result;
}

__attribute__((destructor)) static void unload(void) {
    if (log_file) fclose(log_file);
    if (next_module) dlclose(next_module);
}
