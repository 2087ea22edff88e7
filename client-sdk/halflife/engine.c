#include "engine.h"

#include <string.h>

static engine_function calls[engine_call_count];
static const struct engine_globals* engine_globals;

void engine_connect(const engine_function* table, const struct engine_globals* globals) {
    memcpy(calls, table, sizeof calls);
    engine_globals = globals;
}

double engine_time(void) {
    return (double)engine_globals->time;
}

double engine_frame_time(void) {
    return (double)engine_globals->frame_time;
}

const char* engine_map_name(void) {
    return engine_text(engine_globals->map_name);
}

const char* engine_text(engine_string string) {
    const char* text = ((const char* (*)(int))calls[call_text_of])(string);
    return text != NULL ? text : "";
}

struct entity* engine_entity(int index) {
    return ((struct entity * (*)(int)) calls[call_entity_of])(index);
}

void engine_print(const char* text) {
    ((void (*)(const char*))calls[call_server_print])(text);
}

const char* engine_argument(int index) {
    return ((const char* (*)(int))calls[call_argument])(index);
}

int engine_argument_count(void) {
    return ((int (*)(void))calls[call_argument_count])();
}

void engine_register_cvar(struct cvar* cvar) {
    ((void (*)(struct cvar*))calls[call_register_cvar])(cvar);
}

const struct cvar* engine_find_cvar(const char* name) {
    return ((const struct cvar* (*)(const char*))calls[call_find_cvar])(name);
}

void engine_add_command(const char* name, void (*run)(void)) {
    ((void (*)(const char*, void (*)(void)))calls[call_add_command])(name, run);
}
