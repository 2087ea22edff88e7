/* SPDX-License-Identifier: GPL-2.0-or-later */
/* The game module that the engine loads: forwards every call to the real one and calls the parts in order. */
#define _POSIX_C_SOURCE 200809L
#include "proxy.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

#include "commands.h"
#include "engine.h"
#include "game.h"
#include "roster.h"
#include "viewers.h"

#define EXPORT __attribute__((visibility("default")))

static engine_call call_engine;
static struct settings settings;
static struct module_counters counters;
static struct frame_history history;
static uint32_t life;
static char map_name[64];

const struct module_counters* module_counters(void) {
    return &counters;
}

const struct settings* module_settings(void) {
    return &settings;
}

const struct director_report* module_report(void) {
    return NULL;
}

const char* module_map(void) {
    return map_name;
}

uint32_t module_life(void) {
    return life;
}

/* What the real game calls as its engine. */
static intptr_t answer_game(intptr_t number, ...) {
    intptr_t a[engine_call_arguments], result = 0;
    va_list arguments;
    va_start(arguments, number);
    for (int i = 0; i < engine_call_arguments; ++i) {
        a[i] = va_arg(arguments, intptr_t);
    }
    va_end(arguments);
    if (game_answer_argument(number, a, &result)) return result;
    if (number == ENGINE_LOCATE_GAME_DATA) engine_locate(a);
    if (number == ENGINE_SET_CONFIGSTRING) roster_take_configstring((int)a[0], (const char*)a[1]);
    return call_engine(number, a[0], a[1], a[2], a[3], a[4], a[5], a[6], a[7], a[8], a[9], a[10], a[11],
                       a[12], a[13], a[14]);
}

static int64_t clock_ns(clockid_t clock) {
    struct timespec time;
    clock_gettime(clock, &time);
    return (int64_t)time.tv_sec * 1000000000 + time.tv_nsec;
}

static intptr_t initialise(const int arguments[game_call_arguments]) {
    char reason[700];
    ++life;
    history.count = 0;
    engine_forget_game_data();
    roster_reset();
    viewers_reset();
    settings_register();
    settings_read(&settings);
    engine_cvar_string("mapname", map_name, sizeof map_name);
    if (!game_load(answer_game, reason, sizeof reason)) {
        engine_error("camera director: %s\n", reason);
        return 0;
    }
    return game_call(GAME_INIT, arguments);
}

static intptr_t shut_down(const int arguments[game_call_arguments]) {
    const intptr_t result = game_call(GAME_SHUTDOWN, arguments);
    game_unload();
    engine_forget_game_data();
    return result;
}

static void sample_frame(int level_time) {
    struct server_frame* frame = &history.frames[history.count % history_length];
    memset(frame, 0, offsetof(struct server_frame, events));
    frame->life = life;
    frame->level_time = level_time;
    frame->source_time = clock_ns(CLOCK_REALTIME);
    viewers_fill_requests(frame->viewers);
    ++history.count;
    ++counters.frames;
}

static intptr_t run_frame(const int arguments[game_call_arguments], int64_t start) {
    const int64_t game_start = clock_ns(CLOCK_MONOTONIC);
    const intptr_t result = game_call(GAME_RUN_FRAME, arguments);
    const int64_t game_end = clock_ns(CLOCK_MONOTONIC);
    if (engine_player_state(0) == NULL) return result;
    sample_frame(arguments[0]);
    viewers_apply(module_report(), &history);
    const int64_t cost = clock_ns(CLOCK_MONOTONIC) - game_end + game_start - start;
    ++counters.calls;
    counters.total_ns += cost;
    if (cost > counters.max_ns) counters.max_ns = cost;
    return result;
}

static bool is_slot(int number) {
    return number >= 0 && number < max_slots;
}

EXPORT void dllEntry(engine_call call) {
    /* No call to the engine is allowed before GAME_INIT. */
    call_engine = call;
    engine_attach(call);
}

EXPORT intptr_t vmMain(int command, int a0, int a1, int a2, int a3, int a4, int a5, int a6, int a7, int a8,
                       int a9, int a10, int a11) {
    const int64_t start = clock_ns(CLOCK_MONOTONIC);
    const int arguments[game_call_arguments] = {a0, a1, a2, a3, a4, a5, a6, a7, a8, a9, a10, a11};
    viewers_restore();
    switch (command) {
        case GAME_INIT:
            return initialise(arguments);
        case GAME_SHUTDOWN:
            return shut_down(arguments);
        case GAME_RUN_FRAME:
            return run_frame(arguments, start);
        case GAME_CONSOLE_COMMAND:
            return commands_console() ? 1 : game_call(command, arguments);
        case GAME_CLIENT_COMMAND:
            return is_slot(a0) && commands_client(a0) ? 0 : game_call(command, arguments);
        case GAME_CLIENT_DISCONNECT:
            if (is_slot(a0)) viewers_disconnect(a0);
            return game_call(command, arguments);
        default:
            return game_call(command, arguments);
    }
}
