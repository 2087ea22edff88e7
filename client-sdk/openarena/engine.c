/* SPDX-License-Identifier: GPL-2.0-or-later */
#include "engine.h"

#include <stdarg.h>
#include <stdio.h>

#include "frame.h"

static engine_call call_engine;

static struct {
    uint8_t *entities, *clients;
    int entity_count;
    size_t entity_size, client_size;
} game_data;

void engine_attach(engine_call call) {
    call_engine = call;
}

void engine_locate(const intptr_t arguments[engine_call_arguments]) {
    const intptr_t entity_count = (int)arguments[1], entity_size = (int)arguments[2];
    const intptr_t client_size = (int)arguments[4];
    engine_forget_game_data();
    if (arguments[0] == 0 || arguments[3] == 0 || entity_count < max_slots || entity_count > max_entities ||
        entity_size < entity_shared_size || client_size < player_state_size) {
        return;
    }
    game_data.entities = (uint8_t*)arguments[0];
    game_data.entity_count = (int)entity_count;
    game_data.entity_size = (size_t)entity_size;
    game_data.clients = (uint8_t*)arguments[3];
    game_data.client_size = (size_t)client_size;
}

void engine_forget_game_data(void) {
    memset(&game_data, 0, sizeof game_data);
}

uint8_t* engine_player_state(int slot) {
    return game_data.clients == NULL ? NULL : game_data.clients + (size_t)slot * game_data.client_size;
}

int engine_entity_count(void) {
    return game_data.entity_count;
}

const uint8_t* engine_entity(int number) {
    return game_data.entities + (size_t)number * game_data.entity_size;
}

uint8_t* engine_mutable_entity(int number) {
    return game_data.entities + (size_t)number * game_data.entity_size;
}

void engine_link_entity(uint8_t* entity) {
    call_engine(ENGINE_LINK_ENTITY, (intptr_t)entity);
}

void engine_print(const char* format, ...) {
    char text[1024];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    call_engine(ENGINE_PRINT, (intptr_t)text);
}

static void make_printable(char* text) {
    for (; *text != '\0'; ++text) {
        const unsigned char c = (unsigned char)*text;
        if (c == '"') *text = '\'';
        if (c < ' ' || c == 127) *text = ' ';
    }
}

void engine_print_line(int slot, const char* format, ...) {
    char line[400], command[420];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(line, sizeof line, format, arguments);
    va_end(arguments);
    make_printable(line);
    if (slot < 0) {
        engine_print("%s\n", line);
        return;
    }
    snprintf(command, sizeof command, "print \"%s\n\"\n", line);
    engine_send_command(slot, command);
}

void engine_error(const char* format, ...) {
    char text[1024];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    call_engine(ENGINE_ERROR, (intptr_t)text);
}

void engine_cvar_register(const char* name, const char* value, enum cvar_access access) {
    call_engine(ENGINE_CVAR_REGISTER, (intptr_t)NULL, (intptr_t)name, (intptr_t)value, (intptr_t)access);
}

void engine_cvar_set(const char* name, const char* value) {
    call_engine(ENGINE_CVAR_SET, (intptr_t)name, (intptr_t)value);
}

int engine_cvar_integer(const char* name) {
    return (int)call_engine(ENGINE_CVAR_INTEGER, (intptr_t)name);
}

void engine_cvar_string(const char* name, char* text, size_t size) {
    text[0] = '\0';
    call_engine(ENGINE_CVAR_STRING, (intptr_t)name, (intptr_t)text, (intptr_t)size);
    text[size - 1] = '\0';
}

void engine_enter_command(const char* line) {
    static const intptr_t now = 0;
    call_engine(ENGINE_CONSOLE_COMMAND, now, (intptr_t)line);
}

int engine_argument_count(void) {
    return (int)call_engine(ENGINE_ARGC);
}

void engine_argument(int index, char* text, size_t size) {
    text[0] = '\0';
    call_engine(ENGINE_ARGV, (intptr_t)index, (intptr_t)text, (intptr_t)size);
    text[size - 1] = '\0';
}

void engine_send_command(int slot, const char* command) {
    call_engine(ENGINE_SEND_SERVER_COMMAND, (intptr_t)slot, (intptr_t)command);
}

void engine_configstring(int number, char* text, size_t size) {
    text[0] = '\0';
    call_engine(ENGINE_GET_CONFIGSTRING, (intptr_t)number, (intptr_t)text, (intptr_t)size);
    text[size - 1] = '\0';
}

void engine_user_angles(int slot, int32_t angles[3]) {
    enum { user_command_size = 24, user_command_angles = 4 };
    uint8_t command[user_command_size] = {0};
    call_engine(ENGINE_GET_USER_COMMAND, (intptr_t)slot, (intptr_t)command);
    memcpy(angles, command + user_command_angles, 3 * sizeof *angles);
}
