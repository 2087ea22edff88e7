/* SPDX-License-Identifier: GPL-2.0-or-later */
/* The game module that the engine loads: forwards every call to the real one and calls the parts in order. */
#define _POSIX_C_SOURCE 200809L
#include "proxy.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "commands.h"
#include "engine.h"
#include "events.h"
#include "exchange.h"
#include "game.h"
#include "game/thread.h"
#include "movers.h"
#include "poses.h"
#include "roster.h"
#include "viewers.h"
#include "worker.h"

#define EXPORT __attribute__((visibility("default")))

enum { settings_period_ms = 1000 };

static engine_call call_engine;
static bool passive; /* another copy of this module is at work in this process: this one only forwards */
static uint32_t life;
static char map_name[64];
static struct settings settings;
static struct proxy_counters counters;
static struct frame_history history;

/* The worker and what it has been sent. */
static struct exchange* exchange; /* null: no thread could be started */
static bool match_sent;
static uint32_t sent_roster;
static int settings_time; /* level time at which the settings were read */
/* Events of the frames since the last one that the worker could take. */
static struct game_event undelivered[max_events];
static uint32_t undelivered_count;

/* Time in the real game, within the call of the engine in progress. */
static int call_depth;
static int64_t game_ns, own_ns;

const struct proxy_counters* module_counters(void) {
    return &counters;
}

const struct settings* module_settings(void) {
    return &settings;
}

const struct director_report* module_report(void) {
    if (exchange == NULL || !settings.match.enabled) return NULL;
    const struct director_report* report = exchange_newest_report(exchange);
    return report != NULL && report->life == life ? report : NULL;
}

const char* module_map(void) {
    return map_name;
}

uint32_t module_life(void) {
    return life;
}

/* ------------------------------------------------------------------------------------------- the game */

static void take_configstring(int number, const char* text) {
    roster_take_configstring(number, text);
    events_take_configstring(number, text);
    viewers_take_configstring(number);
}

/* What the real game calls as its engine. Reads more arguments than most calls have, as engines do. */
__attribute__((no_sanitize("address"))) static intptr_t answer_game(intptr_t number, ...) {
    intptr_t a[engine_call_arguments], result = 0;
    va_list arguments;
    va_start(arguments, number);
    for (int i = 0; i < engine_call_arguments; ++i) {
        a[i] = va_arg(arguments, intptr_t);
    }
    va_end(arguments);
    if (game_answer_argument(number, a, &result)) return result;
    if (number == ENGINE_LOCATE_GAME_DATA) engine_locate(a);
    if (number == ENGINE_SET_CONFIGSTRING) take_configstring((int)a[0], (const char*)a[1]);
    return call_engine(number, a[0], a[1], a[2], a[3], a[4], a[5], a[6], a[7], a[8], a[9], a[10], a[11],
                       a[12], a[13], a[14]);
}

/* Calls the game; a call within a call of the game counts as the game's time. */
static intptr_t forward(int command, const int arguments[game_call_arguments]) {
    if (call_depth > 1) return game_call(command, arguments);
    const int64_t start = clock_ns(CLOCK_MONOTONIC);
    const intptr_t result = game_call(command, arguments);
    game_ns += clock_ns(CLOCK_MONOTONIC) - start;
    return result;
}

/* ----------------------------------------------------------------------------------------- the worker */

/* Before a life, also of a server that publishes nothing yet: a frame must not wait for memory and a thread.
 */
static void start_worker(void) {
    if (exchange != NULL) return;
    exchange = exchange_create();
    if (exchange == NULL || !worker_start(exchange)) {
        engine_print("camera director: no thread could be started, poses are not published\n");
        exchange_destroy(exchange);
        exchange = NULL;
    }
}

_Static_assert((int)max_slots == (int)match_max_players, "the place of a player is the slot");

static void send_match(void) {
    struct match_message match;
    match.state.life = life;
    memcpy(match.state.map, map_name, sizeof match.state.map);
    match.state.settings = settings.match;
    for (int slot = 0; slot < max_slots; ++slot) {
        match.state.players[slot] = *roster_at(slot);
    }
    memcpy(match.record, settings.record, sizeof match.record);
    match_sent = exchange_send_match(exchange, &match);
    sent_roster = roster_version();
}

static void read_settings(int level_time) {
    if (level_time >= settings_time && level_time - settings_time < settings_period_ms) return;
    settings_time = level_time;
    if (!settings_read(&settings)) return;
    match_sent = false;
    movers_reset(); /* a recording that begins now has every mover */
}

static void hand_over(const struct server_frame* frame) {
    if (exchange == NULL) return;
    if (!match_sent || sent_roster != roster_version()) send_match();
    if (!settings.match.enabled) return;
    if (match_sent && exchange_send_frame(exchange, frame)) {
        undelivered_count = 0;
        return;
    }
    ++counters.dropped;
    undelivered_count = frame->event_count;
    memcpy(undelivered, frame->events, frame->event_count * sizeof *undelivered);
    movers_reset(); /* the next frame has all of them */
}

/* --------------------------------------------------------------------------------- the engine's calls */

/* Another copy, for instance one that stands where the real game is expected, would publish the match twice.
 * The engine's cvars are what all copies share. */
static bool claim_process(void) {
    static const char name[] = "director_module";
    char mine[32], other[32];
    snprintf(mine, sizeof mine, "%p", (void*)&life);
    engine_cvar_register(name, "", cvar_open);
    engine_cvar_string(name, other, sizeof other);
    if (other[0] != '\0' && strcmp(other, mine) != 0) return false;
    engine_cvar_set(name, mine);
    return true;
}

static intptr_t initialise(const int arguments[game_call_arguments]) {
    char reason[1000];
    passive = !claim_process();
    if (passive) engine_print("camera director: the module is loaded twice, this copy only forwards\n");
    engine_forget_game_data();
    if (!game_load(answer_game, reason, sizeof reason)) {
        engine_error("camera director: %s\n", reason);
        return 0;
    }
    if (passive) return forward(GAME_INIT, arguments);
    ++life;
    history.count = 0;
    undelivered_count = 0;
    counters.timed_frames = 0;
    counters.total_ns = counters.max_ns = 0;
    match_sent = false;
    settings_register();
    (void)settings_read(&settings);
    settings_time = arguments[0];
    engine_cvar_string("mapname", map_name, sizeof map_name);
    roster_reset();
    events_reset(events_game_kind(engine_cvar_integer("g_gametype")));
    movers_reset();
    viewers_reset();
    start_worker();
    const intptr_t result = forward(GAME_INIT, arguments);
    if (exchange != NULL) send_match();
    return result;
}

static intptr_t shut_down(const int arguments[game_call_arguments]) {
    const intptr_t result = forward(GAME_SHUTDOWN, arguments);
    game_unload();
    engine_forget_game_data();
    if (!passive) {
        if (exchange != NULL) (void)exchange_send_end(exchange);
        engine_cvar_set("director_module", "");
    }
    return result;
}

static void sample_frame(struct server_frame* frame, int level_time) {
    memset(frame, 0, offsetof(struct server_frame, events));
    frame->life = life;
    frame->level_time = level_time;
    frame->source_time = clock_ns(CLOCK_REALTIME);
    poses_sample(frame->players);
    frame->event_count = undelivered_count;
    memcpy(frame->events, undelivered, undelivered_count * sizeof *undelivered);
    events_sample(frame);
    movers_sample(frame);
    viewers_fill_requests(frame->viewers);
    counters.events += frame->event_count - undelivered_count;
    ++counters.frames;
}

static intptr_t run_frame(const int arguments[game_call_arguments]) {
    const int level_time = arguments[0];
    const intptr_t result = forward(GAME_RUN_FRAME, arguments);
    read_settings(level_time);
    if (engine_player_state(0) == NULL) return result;
    struct server_frame* frame = &history.frames[history.count % history_length];
    sample_frame(frame, level_time);
    ++history.count;
    hand_over(frame);
    viewers_apply(module_report(), &history);
    return result;
}

static bool is_slot(int number) {
    return number >= 0 && number < max_slots;
}

static intptr_t dispatch(int command, const int arguments[game_call_arguments]) {
    const int slot = arguments[0];
    intptr_t result;
    switch (command) {
        case GAME_INIT:
            return initialise(arguments);
        case GAME_SHUTDOWN:
            return shut_down(arguments);
        case GAME_RUN_FRAME:
            return passive ? forward(command, arguments) : run_frame(arguments);
        case GAME_CONSOLE_COMMAND:
            return !passive && commands_console() ? 1 : forward(command, arguments);
        case GAME_CLIENT_COMMAND:
            return !passive && is_slot(slot) && commands_client(slot) ? 0 : forward(command, arguments);
        case GAME_CLIENT_CONNECT:
            if (!passive && is_slot(slot)) viewers_connect(slot, arguments[1] != 0, arguments[2] != 0);
            return forward(command, arguments);
        case GAME_CLIENT_DISCONNECT:
            result = forward(command, arguments);
            if (!passive && is_slot(slot)) viewers_disconnect(slot);
            return result;
        default:
            return forward(command, arguments);
    }
}

static void count_time(int command, int64_t duration) {
    own_ns += duration - game_ns;
    game_ns = 0;
    if (command == GAME_INIT || command == GAME_SHUTDOWN) own_ns = 0;
    if (command != GAME_RUN_FRAME) return;
    ++counters.timed_frames;
    counters.total_ns += own_ns;
    if (own_ns > counters.max_ns) counters.max_ns = own_ns;
    own_ns = 0;
}

/* The engine sends snapshots after the game's frame; in between it drops the clients that timed out. */
static bool snapshots_may_follow(int command) {
    return command == GAME_RUN_FRAME || command == GAME_CLIENT_DISCONNECT;
}

EXPORT void dllEntry(engine_call call) {
    /* No call to the engine is allowed before GAME_INIT. */
    call_engine = call;
    engine_attach(call);
    call_depth = 0;
}

EXPORT intptr_t vmMain(int command, int a0, int a1, int a2, int a3, int a4, int a5, int a6, int a7, int a8,
                       int a9, int a10, int a11) {
    const int arguments[game_call_arguments] = {a0, a1, a2, a3, a4, a5, a6, a7, a8, a9, a10, a11};
    const int64_t start = clock_ns(CLOCK_MONOTONIC);
    ++call_depth;
    viewers_suspend();
    const intptr_t result = dispatch(command, arguments);
    viewers_resume(snapshots_may_follow(command));
    if (--call_depth == 0) count_time(command, clock_ns(CLOCK_MONOTONIC) - start);
    return result;
}
