/* SPDX-License-Identifier: GPL-2.0-or-later */
/*
 * A game module that plays a recorded match in place of a live one, for clients that record it: bots stand
 * where the players were, and every spectator is shown a camera path. Poses and paths are files, as
 * `camera-director evaluate` reads and writes them.
 *
 *     film_trace    the match: CSV, plain or .gz
 *     film_cameras  the camera paths: CSV, plain or .gz
 *     film_movers   doors and lifts: CSV, plain or .gz, as a recording has it; "" = as the game has them
 *     film_players  the players filmed, "0,3": the first spectator gets the camera of the first of them ...
 *     film_from, film_to  ms since the match's first pose; to its end when film_to is 0
 *
 * Until `film start` on the server's console the match stands at its first moment. Clients and the console
 * are told "film: begin" and "film: end". Shots and items in use are not played.
 */
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "engine.h"
#include "frame.h"
#include "game.h"
#include "overlay.h"
#include "puppets.h"
#include "scenery.h"
#include "take.h"

#define EXPORT __attribute__((visibility("default")))

static engine_call call_engine;
static int call_depth;
static struct take take;
static const struct track* filmed[max_slots]; /* camera paths, in the order of film_players */
static size_t filmed_count;
static double from, to; /* ms of the match */
static double shown;    /* the time that clients were sent last */
static int32_t begin;   /* level time of `from` */
static enum { adding_bots, waiting, starting, playing, ended } state;
static struct overlay overlays[max_slots];

/* ------------------------------------------------------------------------------------------ the take */

static void read_players(void) {
    char text[256], *next = text;
    engine_cvar_string("film_players", text, sizeof text);
    for (filmed_count = 0; filmed_count < max_slots && *next != '\0';) {
        char* end;
        const long player = strtol(next, &end, 10);
        const struct track* const camera = tracks_find(&take.cameras, (int)player);
        if (end == next || (*end != ',' && *end != '\0')) {
            engine_error("film: film_players '%s': expected numbers with commas between them\n", text);
            return;
        }
        if (camera == NULL) {
            engine_error("film: player %ld has no camera in film_cameras\n", player);
            return;
        }
        filmed[filmed_count++] = camera;
        next = *end == ',' ? end + 1 : end;
    }
    if (filmed_count == 0) engine_error("film: film_players names nobody\n");
}

static void read_take(void) {
    static const char* const names[] = {"film_trace",   "film_cameras", "film_movers",
                                        "film_players", "film_from",    "film_to"};
    char trace[512], cameras[512], movers[512], reason[1600];
    for (size_t i = 0; i < sizeof names / sizeof *names; ++i)
        engine_cvar_register(names[i], "", cvar_open);
    engine_cvar_string("film_trace", trace, sizeof trace);
    engine_cvar_string("film_cameras", cameras, sizeof cameras);
    engine_cvar_string("film_movers", movers, sizeof movers);
    take_close(&take);
    if (!take_open(&take, trace, cameras, movers, reason, sizeof reason)) {
        engine_error("film: %s\n", reason);
        return;
    }
    const int end = engine_cvar_integer("film_to");
    from = take.first + engine_cvar_integer("film_from");
    to = end > 0 ? fmin(take.first + end, take.last) : take.last;
    if (from < take.first || from >= to) {
        engine_error("film: the match lasts %.1f s: nothing of it is between film_from and film_to\n",
                     (take.last - take.first) / 1000);
        return;
    }
    read_players();
}

/* --------------------------------------------------------------------------------------- the playback */

static void announce(const char* what) {
    char command[64];
    snprintf(command, sizeof command, "print \"film: %s\n\"", what);
    engine_send_command(-1, command);
    engine_print("film: %s\n", what);
}

/* The time of the match at a level time. */
static double advance(int32_t level_time) {
    if (state == adding_bots && puppets_enter(&take)) {
        engine_print("film: ready\n");
        state = waiting;
    }
    if (state == starting) {
        begin = level_time;
        state = playing;
        announce("begin");
    }
    if (state == playing && level_time - begin > to - from) {
        state = ended;
        announce("end");
    }
    if (state == ended) return to;
    return state == playing ? from + (level_time - begin) : from;
}

static bool is_spectator(int slot) {
    const uint8_t* const entity = engine_entity(slot);
    return read_int(entity, ENTITY_IN_USE) != 0 &&
           (read_int(entity, ENTITY_SERVER_FLAGS) & ENTITY_BOT) == 0 &&
           read_element(engine_player_state(slot), PS_PERSISTANT, PERSISTANT_TEAM) == team_spectator;
}

static size_t spectator_count(void) {
    size_t count = 0;
    for (int slot = 0; slot < max_slots; ++slot)
        count += is_spectator(slot);
    return count;
}

static void show(int32_t level_time, double time) {
    size_t index = 0;
    for (int slot = 0; slot < max_slots && index < filmed_count; ++slot) {
        if (!is_spectator(slot)) continue;
        bool cut;
        const struct view view = take_view(&take, filmed[index++], shown, time, &cut);
        overlay_show_camera(&overlays[slot], slot, level_time, &view, cut);
    }
    shown = time;
}

static void run_frame(int32_t level_time) {
    if (engine_player_state(0) == NULL || take.poses.track_count == 0) return;
    const double time = advance(level_time);
    puppets_pose(&take, time);
    scenery_pose(&take, time);
    show(level_time, time);
}

static bool take_command(void) {
    char name[16], word[16];
    engine_argument(0, name, sizeof name);
    engine_argument(1, word, sizeof word);
    if (strcmp(name, "film") != 0 || strcmp(word, "start") != 0) return false;
    if (state != waiting)
        engine_print("film: %s\n",
                     state == adding_bots ? "not all players are in the game yet" : "it runs, or has ended");
    else if (spectator_count() < filmed_count)
        engine_print("film: %zu spectators are needed, one for each of film_players; there are %zu\n",
                     filmed_count, spectator_count());
    else
        state = starting;
    return true;
}

/* ------------------------------------------------------------------------------------ the engine's calls */

static void put_overlays(void (*put)(struct overlay*, uint8_t*)) {
    for (int slot = 0; slot < max_slots && engine_player_state(0) != NULL; ++slot)
        put(&overlays[slot], engine_player_state(slot));
}

/* What the real game calls as its engine. */
static intptr_t answer_game(intptr_t number, ...) {
    intptr_t a[engine_call_arguments];
    va_list arguments;
    va_start(arguments, number);
    for (int i = 0; i < engine_call_arguments; ++i)
        a[i] = va_arg(arguments, intptr_t);
    va_end(arguments);
    if (number == ENGINE_LOCATE_GAME_DATA) engine_locate(a);
    return call_engine(number, a[0], a[1], a[2], a[3], a[4], a[5], a[6], a[7], a[8], a[9], a[10], a[11],
                       a[12], a[13], a[14]);
}

static intptr_t initialise(const int arguments[game_call_arguments]) {
    char reason[1000];
    engine_forget_game_data();
    memset(overlays, 0, sizeof overlays);
    state = adding_bots;
    if (!game_load(answer_game, reason, sizeof reason)) {
        engine_error("film: %s\n", reason);
        return 0;
    }
    read_take();
    shown = from;
    return game_call(GAME_INIT, arguments);
}

static intptr_t shut_down(const int arguments[game_call_arguments]) {
    const intptr_t result = game_call(GAME_SHUTDOWN, arguments);
    engine_forget_game_data();
    game_unload();
    take_close(&take);
    return result;
}

static intptr_t dispatch(int command, const int arguments[game_call_arguments]) {
    if (command == GAME_INIT) return initialise(arguments);
    if (command == GAME_SHUTDOWN) return shut_down(arguments);
    if (command == GAME_RUN_BOTS && engine_player_state(0) != NULL && puppets_can_stand()) return 0;
    if (command == GAME_CONSOLE_COMMAND && take_command()) return 1;
    const intptr_t result = game_call(command, arguments);
    if (command == GAME_RUN_FRAME) run_frame(arguments[0]);
    return result;
}

EXPORT void dllEntry(engine_call call) {
    call_engine = call;
    engine_attach(call);
    call_depth = 0;
}

EXPORT intptr_t vmMain(int command, int a0, int a1, int a2, int a3, int a4, int a5, int a6, int a7, int a8,
                       int a9, int a10, int a11) {
    const int arguments[game_call_arguments] = {a0, a1, a2, a3, a4, a5, a6, a7, a8, a9, a10, a11};
    if (command == GAME_INIT) call_depth = 0; /* a game that ended by an error never returned */
    if (call_depth++ == 0) put_overlays(overlay_take_off);
    const intptr_t result = dispatch(command, arguments);
    if (--call_depth == 0) put_overlays(overlay_put_on);
    return result;
}
