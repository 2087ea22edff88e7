/* What Metamod loads: the plugin's entry points, and the functions of the game and the engine that it
 * follows. */
#include <string.h>

#include "engine.h"
#include "game.h"
#include "messages.h"
#include "players.h"
#include "settings.h"

#define EXPORTED __attribute__((visibility("default")))

static const struct plugin_info description = {METAMOD_INTERFACE_VERSION,
                                               "Camera director",
                                               "1.0",
                                               __DATE__,
                                               "The camera director's authors",
                                               "",
                                               "DIRECTOR",
                                               load_at_startup,
                                               load_at_startup};
static const engine_function* metamod_calls;
static struct metamod_globals* metamod_globals;

static void ignore(void) {
    metamod_globals->result = metamod_ignored;
}

static int find_message(const char* name) {
    typedef int (*find_function)(const struct plugin_info*, const char*, int*);
    int size = 0;
    return ((find_function)metamod_calls[metamod_message_id])(&description, name, &size);
}

/* The game's functions, after the game has run them. */

static void on_server_activate(struct entity* entities, int count, int max_clients) {
    game_begin_map(entities, count, max_clients, find_message);
    ignore();
}

static void on_server_deactivate(void) {
    game_end_map();
    ignore();
}

static void on_start_frame(void) {
    game_run_frame();
    ignore();
}

static int give_game_functions(engine_function* table, int* version) {
    if (*version != game_interface_version) {
        *version = game_interface_version;
        return 0;
    }
    table[call_server_activate] = (engine_function)on_server_activate;
    table[call_server_deactivate] = (engine_function)on_server_deactivate;
    table[call_start_frame] = (engine_function)on_start_frame;
    return 1;
}

/* The engine's functions, after the engine has run them for the game. */

static void on_message_begin(int destination, int type, const float* origin, struct entity* receiver) {
    (void)destination;
    (void)origin;
    messages_begin(type, game_player_id(receiver));
    ignore();
}

static void on_message_end(void) {
    struct game_event event;
    if (messages_end(&event)) game_add_event(&event);
    ignore();
}

static void on_write_byte(int value) {
    messages_byte(value);
    ignore();
}

static void on_write_string(const char* text) {
    messages_text(text);
    ignore();
}

static int give_engine_functions(engine_function* table, int* version) {
    if (*version != engine_interface_version) {
        *version = engine_interface_version;
        return 0;
    }
    table[call_message_begin] = (engine_function)on_message_begin;
    table[call_message_end] = (engine_function)on_message_end;
    table[call_write_byte] = (engine_function)on_write_byte;
    table[call_write_string] = (engine_function)on_write_string;
    return 1;
}

/* The entry points, in the order of the calls. */

EXPORTED void GiveFnptrsToDll(const engine_function* table, const struct engine_globals* globals) {
    engine_connect(table, globals);
}

EXPORTED int Meta_Query(const char* version, const struct plugin_info** info, const engine_function* calls) {
    *info = &description;
    metamod_calls = calls;
    const size_t major = strcspn(METAMOD_INTERFACE_VERSION, ":");
    return strncmp(version, METAMOD_INTERFACE_VERSION, major + 1) == 0;
}

static void run_command(void) {
    if (engine_argument_count() == 2 && strcmp(engine_argument(1), "status") == 0) {
        game_print_status();
    } else {
        engine_print("usage: director status\n");
    }
}

EXPORTED int Meta_Attach(int now, engine_function* table, struct metamod_globals* globals,
                         void* game_tables) {
    (void)now;
    (void)game_tables;
    metamod_globals = globals;
    memset(table, 0, plugin_call_count * sizeof *table);
    table[plugin_game_post] = (engine_function)give_game_functions;
    table[plugin_engine_post] = (engine_function)give_engine_functions;
    settings_register();
    engine_add_command("director", run_command);
    return 1;
}

EXPORTED int Meta_Detach(int now, int reason) {
    (void)now;
    (void)reason;
    game_close();
    return 1;
}

/* The server ends without detaching its plugins. */
__attribute__((destructor)) static void close_at_exit(void) {
    game_close();
}
