/*
 * What the plugin must know of the binary interface between Metamod, the Half-Life engine (GoldSrc) and the
 * game, and the engine's services as C functions. Tables of function pointers are arrays here, with the
 * places of the functions that are used. On Linux all calls have the C calling convention. A real server is a
 * 32-bit program; the layouts follow the size of a pointer, so that tests can act the server on any machine.
 */
#ifndef CAMERA_DIRECTOR_HALFLIFE_ENGINE_H
#define CAMERA_DIRECTOR_HALFLIFE_ENGINE_H

#include <stddef.h>
#include <stdint.h>

typedef void (*engine_function)(void);
typedef int32_t engine_string; /* place in the engine's strings; 0 = "" */

enum { game_interface_version = 140, engine_interface_version = 138 };
#define METAMOD_INTERFACE_VERSION "5:13" /* major:minor; a plugin works with the same major */

/* Places in the engine's table. */
enum engine_call {
    call_message_begin = 46,  /* void (int destination, int type, const float* origin, entity* receiver) */
    call_message_end = 47,    /* void (void) */
    call_write_byte = 48,     /* void (int) */
    call_write_string = 54,   /* void (const char*) */
    call_register_cvar = 56,  /* void (struct cvar*) */
    call_text_of = 66,        /* const char* (int) */
    call_entity_of = 72,      /* entity* (int index) */
    call_server_print = 81,   /* void (const char*) */
    call_argument = 83,       /* const char* (int) */
    call_argument_count = 84, /* int (void) */
    call_find_cvar = 116,     /* struct cvar* (const char*) */
    call_add_command = 140,   /* void (char* name, void (*)(void)) */
    engine_call_count = 141   /* of those that every engine has */
};

/* Places in the game's table. */
enum game_call {
    call_server_activate = 21,   /* void (entity* entities, int count, int max_clients): a map has begun */
    call_server_deactivate = 22, /* void (void): the map ends */
    call_start_frame = 25,       /* void (void): once per server frame, after the players' commands */
    game_call_count = 50
};

/* Places in Metamod's table of services, and in that of the functions that a plugin follows. */
enum metamod_call {
    metamod_message_id = 8 /* int (plugin_info*, const char* name, int* size); 0 = no such message */
};
enum plugin_call { plugin_game_post = 3, plugin_engine_post = 7, plugin_call_count = 8 };

enum metamod_result { metamod_ignored = 1 };
enum load_time { load_at_startup = 1 };

struct metamod_globals {
    int result; /* metamod_result of the plugin's function */
    int previous_result, status;
    void *original_return, *overriding_return;
};

struct plugin_info {
    const char *interface_version, *name, *version, *date, *author, *url, *log_tag;
    int loadable, unloadable; /* load_time */
};

struct cvar {
    const char* name;
    const char* text;
    int32_t flags;
    float value;
    struct cvar* next;
};
enum { cvar_of_game = 8 };

/* The beginning of the engine's global variables. */
struct engine_globals {
    float time; /* s since the map began */
    float frame_time;
    float force_retouch;
    engine_string map_name;
};

struct entity;

struct entity_variables {
    engine_string class_name, global_name;
    float origin[3], old_origin[3], velocity[3];
    float base_velocity[3], client_base_velocity[3], move_direction[3];
    float model_angles[3], angular_velocity[3], punch_angles[3];
    float view_angles[3]; /* degrees; pitch (positive looks down), yaw, roll */
    float path[2][3], path_times[2];
    int32_t fix_angles; /* not 0: the view angles were set, as at a spawn or teleport */
    float ideal_angles[4];
    int32_t models[4];
    float bounds[5][3];
    float local_time, next_think;
    int32_t move_type, solid, skin, body, effects;
    float gravity, friction;
    int32_t light_level, sequence, gait_sequence;
    float animation[3];
    uint8_t bones[6], padding[2];
    float scale;
    int32_t render_mode;
    float render_amount, render_colour[3];
    int32_t render_effect;
    float health, frags;
    int32_t weapons;
    float take_damage;
    int32_t dead; /* 0 = alive */
    float view_offset[3];
    int32_t buttons, impulse;
    struct entity* chain;
    struct entity* damage_inflictor; /* of the last damage: a player, or a projectile that a player owns */
    struct entity *enemy, *aimed_entity;
    struct entity* owner;
    struct entity* ground_entity;
    int32_t spawn_flags, flags, colour_map, team;
    float max_health, teleport_time, armour_type, armour;
    int32_t water_level, water_type;
    engine_string target, target_name;
    engine_string player_name;
    engine_string message;
    float damage[4];
    engine_string noises[4];
    float timers[4];
    struct entity* containing_entity;
    int32_t player_class;
    float max_speed, field_of_view;
    int32_t weapon_animation, push_ms, ducking, step_sound_time, swim_time, duck_time, left_step;
    float fall_velocity;
    int32_t game_state, old_buttons, group;
    int32_t observer_mode; /* not 0: spectates */
    int32_t user_integers[3];
    float user_floats[4], user_vectors[4][3];
    struct entity* user_entities[4];
};

/* Values of flags. */
enum {
    entity_client = 1 << 3,
    entity_proxy = 1 << 20, /* a relay for spectators */
    entity_spectator = 1 << 26
};

struct entity {
    int32_t free, serial_number;
    void* area[2];
    int32_t head_node, leaf_count;
    int16_t leaves[48];
    float free_time;
    void* game_data; /* null until the game has put the client in */
    struct entity_variables variables;
};

#if defined(__i386__)
_Static_assert(sizeof(struct entity) == 804 && offsetof(struct entity, variables) == 128, "");
_Static_assert(sizeof(struct entity_variables) == 676, "");
_Static_assert(offsetof(struct entity_variables, view_angles) == 116, "");
_Static_assert(sizeof(struct cvar) == 20 && sizeof(struct plugin_info) == 36, "");
#endif

/* Keeps the engine's functions and globals. */
void engine_connect(const engine_function* table, const struct engine_globals* globals);
double engine_time(void);       /* s since the map began, as exact as a float */
double engine_frame_time(void); /* s since the previous frame */
const char* engine_map_name(void);
const char* engine_text(engine_string string); /* never null */
/* The entity of a player, 1 .. max_clients; null: the engine has none. */
struct entity* engine_entity(int index);
void engine_print(const char* text); /* on the server's console */
const char* engine_argument(int index);
int engine_argument_count(void);
void engine_register_cvar(struct cvar* cvar);
/* The cvar of this name, also one of the engine's; null: there is none. */
const struct cvar* engine_find_cvar(const char* name);
void engine_add_command(const char* name, void (*run)(void));

#endif
