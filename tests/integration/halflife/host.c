/*
 * Acts a Half-Life server with Metamod for one plugin: loads it, keeps entities, cvars and user messages, and
 * runs server frames of 10 ms in real time. Everything is told on the command line:
 *
 *     halflife-host PLUGIN COMMAND [ARGUMENT ...] ...
 *
 * Ends with 0; on the first thing that a server could not bear, with 1 and the reason on standard error.
 */
#include <dirent.h>
#include <dlfcn.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "halflife/engine.h"

enum { entity_limit = 64, client_limit = 8, projectile = 40, cvar_limit = 16, game_calls = game_call_count };
static const double frame_seconds = 0.01;

static struct entity entities[entity_limit];
static struct engine_globals globals;
static engine_function engine_table[engine_call_count];
static engine_function game_post[game_calls], engine_post[engine_call_count];
static struct metamod_globals metamod_globals;
static struct cvar cvars[cvar_limit];
static int cvar_count;
static const char* strings[256] = {""};
static int string_count = 1;
static void (*server_command)(void);
static const char* command_words[2];
static char printed[4096]; /* since the last command */
static const char* const message_names[] = {"DeathMsg", "ItemPickup", "HLTV"};
enum { first_message = 83 };

static void fail(const char* format, ...) {
    va_list arguments;
    va_start(arguments, format);
    fputs("halflife-host: ", stderr);
    vfprintf(stderr, format, arguments);
    fputc('\n', stderr);
    va_end(arguments);
    exit(1);
}

/* ------------------------------------------------------------------------------- the engine's services */

static engine_string add_string(const char* text) {
    if (string_count == 256) fail("too many strings");
    strings[string_count] = text;
    return string_count++;
}

static const char* text_of(int string) {
    if (string < 0 || string >= string_count) fail("string %d does not exist", string);
    return strings[string];
}

static struct entity* entity_of(int index) {
    if (index < 0 || index >= entity_limit) fail("entity %d does not exist", index);
    return index > client_limit && entities[index].game_data == NULL ? NULL : &entities[index];
}

/* Like Metamod, keeps a copy. */
static void register_cvar(struct cvar* cvar) {
    if (cvar_count == cvar_limit) fail("too many cvars");
    struct cvar* copy = &cvars[cvar_count++];
    *copy = *cvar;
    copy->value = strtof(copy->text, NULL);
}

static struct cvar* find_cvar(const char* name) {
    for (int i = 0; i < cvar_count; ++i)
        if (strcmp(cvars[i].name, name) == 0) return &cvars[i];
    return NULL;
}

static void set_cvar(const char* name, const char* text) {
    struct cvar* cvar = find_cvar(name);
    if (cvar == NULL) fail("there is no cvar %s", name);
    cvar->text = text;
    cvar->value = strtof(text, NULL);
}

static void server_print(const char* text) {
    strncat(printed, text, sizeof printed - strlen(printed) - 1);
}

static const char* argument(int index) {
    return index < 2 ? command_words[index] : "";
}

static int argument_count(void) {
    return command_words[1] != NULL ? 2 : 1;
}

static void add_command(const char* name, void (*run)(void)) {
    if (strcmp(name, "director") != 0) fail("unexpected command %s", name);
    server_command = run;
}

static int message_id(const struct plugin_info* plugin, const char* name, int* size) {
    (void)plugin;
    *size = -1;
    for (int i = 0; i < 3; ++i)
        if (strcmp(message_names[i], name) == 0) return first_message + i;
    return 0;
}

/* A call into the plugin must say that it leaves the call alone. */
#define POST(table, call, type, ...)                                                                \
    do {                                                                                            \
        metamod_globals.result = 0;                                                                 \
        if ((table)[call] != NULL) {                                                                \
            ((type)(table)[call])(__VA_ARGS__);                                                     \
            if (metamod_globals.result != metamod_ignored) fail("call %d: no result", (int)(call)); \
        }                                                                                           \
    } while (0)

static void message_begin(int type, struct entity* receiver) {
    typedef void (*begin_function)(int, int, const float*, struct entity*);
    POST(engine_post, call_message_begin, begin_function, receiver != NULL ? 1 : 2, type, NULL, receiver);
}

static void write_byte(int value) {
    POST(engine_post, call_write_byte, void (*)(int), value);
}

static void write_string(const char* text) {
    POST(engine_post, call_write_string, void (*)(const char*), text);
}

static void message_end(void) {
    POST(engine_post, call_message_end, void (*)(void), );
}

/* ------------------------------------------------------------------------------------------ the server */

static void* symbol(void* library, const char* name) {
    void* address = dlsym(library, name);
    if (address == NULL) fail("the plugin does not export %s", name);
    return address;
}

static void* load(const char* path) {
    engine_table[call_text_of] = (engine_function)text_of;
    engine_table[call_entity_of] = (engine_function)entity_of;
    engine_table[call_server_print] = (engine_function)server_print;
    engine_table[call_argument] = (engine_function)argument;
    engine_table[call_argument_count] = (engine_function)argument_count;
    engine_table[call_register_cvar] = (engine_function)register_cvar;
    engine_table[call_find_cvar] = (engine_function)find_cvar;
    engine_table[call_add_command] = (engine_function)add_command;
    static engine_function metamod_table[metamod_message_id + 1];
    metamod_table[metamod_message_id] = (engine_function)message_id;
    static struct cvar port = {.name = "port", .text = "27015"};
    register_cvar(&port);

    void* library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    if (library == NULL) fail("%s", dlerror());
    typedef void (*give_function)(engine_function*, struct engine_globals*);
    typedef int (*query_function)(const char*, const struct plugin_info**, engine_function*);
    typedef int (*attach_function)(int, engine_function*, struct metamod_globals*, void*);
    typedef int (*table_function)(engine_function*, int*);
    union {
        void* address;
        give_function give;
        query_function query;
        attach_function attach;
    } entry;
    entry.address = symbol(library, "GiveFnptrsToDll");
    entry.give(engine_table, &globals);
    entry.address = symbol(library, "Meta_Query");
    const struct plugin_info* info = NULL;
    if (entry.query("4:1", &info, metamod_table))
        fail("the plugin accepts an interface of another major version");
    if (!entry.query(METAMOD_INTERFACE_VERSION, &info, metamod_table)) fail("the plugin refuses Metamod");
    printf("plugin %s %s\n", info->name, info->interface_version);
    entry.address = symbol(library, "Meta_Attach");
    engine_function tables[plugin_call_count];
    memset(tables, 0xff, sizeof tables);
    if (!entry.attach(load_at_startup, tables, &metamod_globals, NULL)) fail("the plugin does not attach");
    for (int i = 0; i < plugin_call_count; ++i)
        if (i != plugin_game_post && i != plugin_engine_post && tables[i] != NULL)
            fail("unexpected table %d", i);
    int version = 1;
    if (((table_function)tables[plugin_game_post])(game_post, &version) || version != game_interface_version)
        fail("the plugin accepts a game of another version");
    if (!((table_function)tables[plugin_game_post])(game_post, &version)) fail("no functions of the game");
    version = engine_interface_version;
    if (!((table_function)tables[plugin_engine_post])(engine_post, &version))
        fail("no functions of the engine");
    return library;
}

static void run_frame(void) {
    globals.time += (float)frame_seconds;
    globals.frame_time = (float)frame_seconds;
    for (int i = 1; i <= client_limit; ++i)
        for (int k = 0; k < 3; ++k)
            entities[i].variables.origin[k] += entities[i].variables.velocity[k] * (float)frame_seconds;
    POST(game_post, call_start_frame, void (*)(void), );
    for (int i = 1; i <= client_limit; ++i)
        entities[i].variables.fix_angles = 0; /* sent to the client */
    const struct timespec pause = {0, (long)(frame_seconds * 1e9)};
    nanosleep(&pause, NULL);
}

static const char* status(void) {
    printed[0] = '\0';
    command_words[0] = "director";
    command_words[1] = "status";
    server_command();
    return printed;
}

static void announce(int message, struct entity* receiver, const char* text) {
    message_begin(first_message + message, receiver);
    if (text != NULL) {
        write_string(text);
    } else {
        write_byte(0);
        write_byte(0);
    }
    message_end();
}

static const int patience = 6000; /* frames, a minute */

/* Runs frames until the plugin's status has a line. */
static void await_status(const char* line) {
    for (int i = 0; i < patience; ++i) {
        run_frame();
        if (i % 10 == 9 && strstr(status(), line) != NULL) return;
    }
    fail("no line \"%s\" in the status:\n%s", line, printed);
}

/* Runs frames until the file exists; begins a round with every tenth, if asked. */
static void await_file(const char* path, int with_rounds) {
    for (int i = 0; i < patience; ++i) {
        if (access(path, F_OK) == 0) return;
        if (with_rounds && i % 10 == 0) announce(2, NULL, NULL);
        run_frame();
    }
    fail("no file %s", path);
}

static void create_file(const char* path) {
    FILE* file = fopen(path, "w");
    if (file == NULL || fclose(file) != 0) fail("cannot create %s", path);
}

static void begin_map(const char* name) {
    memset(entities, 0, sizeof entities);
    globals.time = 1.0f;
    globals.map_name = add_string(name);
    typedef void (*activate_function)(struct entity*, int, int);
    POST(game_post, call_server_activate, activate_function, entities, entity_limit, client_limit);
}

static struct entity_variables* player(const char* number) {
    const int index = atoi(number);
    if (index < 1 || index > client_limit) fail("player %s does not exist", number);
    return &entities[index].variables;
}

static void join(const char* number, const char* name, const char* team) {
    struct entity_variables* variables = player(number);
    entities[atoi(number)].game_data = variables;
    variables->player_name = add_string(name);
    variables->flags = entity_client;
    variables->team = atoi(team);
    variables->health = 100.0f;
    variables->view_offset[2] = 28.0f;
    variables->fix_angles = 1;
}

static void place(struct entity_variables* variables, char** numbers) {
    for (int k = 0; k < 3; ++k) {
        variables->origin[k] = strtof(numbers[k], NULL);
        variables->view_angles[k] = strtof(numbers[3 + k], NULL);
    }
}

static void kill_player(const char* killer, const char* victim, const char* means) {
    message_begin(first_message, NULL);
    write_byte(atoi(killer));
    write_byte(atoi(victim));
    write_byte(1); /* Counter-Strike: a head shot */
    write_string(means);
    message_end();
    player(victim)->dead = 2;
    player(victim)->health = -20.0f;
}

/* The last damage is the player's own, or that of a projectile which is already gone. */
static void hurt(const char* victim, const char* attacker, const char* amount, int by_projectile) {
    struct entity* cause = &entities[atoi(attacker)];
    if (by_projectile) {
        entities[projectile].free = 1;
        entities[projectile].variables.owner = cause;
        cause = &entities[projectile];
    }
    player(victim)->damage_inflictor = cause;
    player(victim)->health -= strtof(amount, NULL);
}

static void detach(void* library) {
    union {
        void* address;
        int (*detach)(int, int);
    } entry = {symbol(library, "Meta_Detach")};
    if (!entry.detach(load_at_startup, 3)) fail("the plugin does not detach");
    memset(game_post, 0, sizeof game_post);
    memset(engine_post, 0, sizeof engine_post);
    dlclose(library);
}

struct command {
    const char* name;
    int arguments;
};

/* Runs the command; words[0] is its name. Returns the number of its arguments. */
static int run_command(char** words, int count, void* library) {
    static const struct command commands[] = {
        {"set", 2},    {"map", 1},   {"end", 0},    {"join", 3},   {"leave", 1},  {"spectate", 1},
        {"place", 7},  {"walk", 4},  {"turn", 1},   {"kill", 3},   {"hurt", 3},   {"rocket", 3},
        {"wild", 1},   {"spawn", 1}, {"broken", 1}, {"pickup", 2}, {"round", 0},  {"run", 1},
        {"expect", 1}, {"wait", 1},  {"rounds", 1}, {"status", 0}, {"detach", 0}, {"create", 1}};
    const char* name = words[0];
    const struct command* command = NULL;
    for (size_t i = 0; i < sizeof commands / sizeof *commands; ++i)
        if (strcmp(commands[i].name, name) == 0) command = &commands[i];
    if (command == NULL || command->arguments >= count)
        fail("%s: unknown command, or too few arguments", name);
    const char* first = command->arguments > 0 ? words[1] : "";
    if (strcmp(name, "set") == 0) set_cvar(first, words[2]);
    if (strcmp(name, "map") == 0) begin_map(first);
    if (strcmp(name, "end") == 0) POST(game_post, call_server_deactivate, void (*)(void), );
    if (strcmp(name, "join") == 0) join(first, words[2], words[3]);
    if (strcmp(name, "leave") == 0) memset(&entities[atoi(first)], 0, sizeof *entities);
    if (strcmp(name, "spectate") == 0) player(first)->observer_mode = 1;
    if (strcmp(name, "place") == 0) place(player(first), &words[2]);
    if (strcmp(name, "walk") == 0)
        for (int k = 0; k < 3; ++k)
            player(first)->velocity[k] = strtof(words[2 + k], NULL);
    if (strcmp(name, "turn") == 0) player(first)->fix_angles = 1;
    if (strcmp(name, "kill") == 0) kill_player(first, words[2], words[3]);
    if (strcmp(name, "hurt") == 0) hurt(first, words[2], words[3], 0);
    if (strcmp(name, "rocket") == 0) hurt(first, words[2], words[3], 1);
    if (strcmp(name, "wild") == 0) {
        player(first)->damage_inflictor = (struct entity*)((char*)&entities[projectile] + 8);
        player(first)->health -= 1.0f;
    }
    if (strcmp(name, "spawn") == 0) {
        player(first)->dead = 0;
        player(first)->health = 100.0f;
    }
    if (strcmp(name, "broken") == 0) player(first)->origin[1] = NAN;
    if (strcmp(name, "pickup") == 0) announce(1, &entities[atoi(first)], words[2]);
    if (strcmp(name, "round") == 0) announce(2, NULL, NULL);
    if (strcmp(name, "run") == 0)
        for (int i = 0; i < atoi(first); ++i)
            run_frame();
    if (strcmp(name, "expect") == 0) await_status(first);
    if (strcmp(name, "wait") == 0) await_file(first, 0);
    if (strcmp(name, "rounds") == 0) await_file(first, 1);
    if (strcmp(name, "status") == 0) fputs(status(), stdout);
    if (strcmp(name, "create") == 0) create_file(first);
    if (strcmp(name, "detach") == 0) detach(library);
    return command->arguments;
}

static int count_threads(void) {
    int entries = 0;
    DIR* tasks = opendir("/proc/self/task");
    while (tasks != NULL && readdir(tasks) != NULL)
        ++entries;
    if (tasks != NULL) closedir(tasks);
    return entries - 2; /* without . and .. */
}

/* Exit handlers run last to first: this one after those of the plugin, which has ended all its threads. One
 * that is joined may be listed for a moment longer. */
static void expect_one_thread(void) {
    const struct timespec pause = {0, 1000 * 1000};
    int threads = count_threads();
    for (int i = 0; i < 1000 && threads != 1; ++i) {
        nanosleep(&pause, NULL);
        threads = count_threads();
    }
    if (threads == 1) return;
    fprintf(stderr, "halflife-host: %d threads at the end\n", threads);
    _exit(1);
}

int main(int count, char** words) {
    if (count < 2) fail("usage: halflife-host PLUGIN COMMAND [ARGUMENT ...] ...");
    atexit(expect_one_thread);
    void* library = load(words[1]);
    for (int i = 2; i < count; ++i)
        i += run_command(&words[i], count - i, library);
    return 0;
}
