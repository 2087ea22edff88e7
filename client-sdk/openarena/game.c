/* SPDX-License-Identifier: GPL-2.0-or-later */
#define _GNU_SOURCE /* dladdr */
#include "game.h"

#include <dlfcn.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "frame.h"

enum { path_size = 512, max_words = 4 };

static const char file_name[] = "qagamex86_64.so";
static const char debian_folder[] = "/usr/lib/openarena-server/baseoa";

static struct {
    void* library;
    game_main main;
    char path[path_size];
} game;

static struct {
    const char* const* words; /* null while the engine's own command is executed */
    int count;
} command;

static bool is_same_file(const char* a, const char* b) {
    struct stat first, second;
    return stat(a, &first) == 0 && stat(b, &second) == 0 && first.st_dev == second.st_dev &&
           first.st_ino == second.st_ino;
}

static bool is_this_module(const char* path) {
    Dl_info info;
    return dladdr(file_name, &info) != 0 && info.dli_fname != NULL && is_same_file(path, info.dli_fname);
}

static bool ends_with(const char* text, const char* end) {
    const size_t length = strlen(text), end_length = strlen(end);
    return length >= end_length && strcmp(text + length - end_length, end) == 0;
}

static bool load(const char* path, engine_call call, char* reason, size_t reason_size) {
    if (ends_with(path, ".qvm")) {
        snprintf(reason, reason_size,
                 "%s is a game in QVM, which cannot be forwarded to: set director_game to a "
                 "native module (%s)",
                 path, file_name);
        return false;
    }
    if (is_this_module(path)) {
        snprintf(reason, reason_size,
                 "%s is this module itself: set director_game to the real game module "
                 "(Debian: %s/%s)",
                 path, debian_folder, file_name);
        return false;
    }
    void* library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    if (library == NULL) {
        snprintf(reason, reason_size, "%s: set director_game to the real game module (Debian: %s/%s)",
                 dlerror(), debian_folder, file_name);
        return false;
    }
    void (*entry)(engine_call);
    *(void**)&entry = dlsym(library, "dllEntry");
    *(void**)&game.main = dlsym(library, "vmMain");
    if (entry == NULL || game.main == NULL) {
        game.main = NULL;
        dlclose(library);
        snprintf(reason, reason_size,
                 "%s is no game module (no dllEntry or vmMain): set director_game to the "
                 "real one (Debian: %s/%s)",
                 path, debian_folder, file_name);
        return false;
    }
    game.library = library;
    snprintf(game.path, sizeof game.path, "%s", path);
    entry(call);
    return true;
}

/* A mod that has only a QVM must not be replaced by the base game's native module. */
bool game_load(engine_call call, char* reason, size_t reason_size) {
    char path[path_size], base[path_size / 2], mod[64], base_game[64];
    game_unload();
    engine_cvar_string("director_game", path, sizeof path);
    if (path[0] != '\0') return load(path, call, reason, reason_size);
    engine_cvar_string("fs_basepath", base, sizeof base);
    engine_cvar_string("fs_game", mod, sizeof mod);
    engine_cvar_string("com_basegame", base_game, sizeof base_game);
    if (base_game[0] == '\0') snprintf(base_game, sizeof base_game, "baseoa");
    const bool is_mod = mod[0] != '\0' && strcmp(mod, base_game) != 0;
    snprintf(path, sizeof path, "%s/%s/%s", base, is_mod ? mod : base_game, file_name);
    if (access(path, R_OK) == 0 && !is_this_module(path)) return load(path, call, reason, reason_size);
    if (!is_mod) {
        snprintf(path, sizeof path, "%s/%s", debian_folder, file_name);
        return load(path, call, reason, reason_size);
    }
    snprintf(reason, reason_size,
             "the game '%s' has no native module %s; a game in QVM cannot be forwarded to: "
             "set director_game to its native module, or remove this module from the home path",
             mod, path);
    return false;
}

bool game_is_loaded(void) {
    return game.library != NULL;
}

const char* game_path(void) {
    return game.path;
}

void game_unload(void) {
    if (game.library != NULL) dlclose(game.library);
    memset(&game, 0, sizeof game);
    memset(&command, 0, sizeof command); /* a game that ended by an error did not return from it */
}

intptr_t game_call(int number, const int arguments[game_call_arguments]) {
    const int* a = arguments;
    if (game.main == NULL) return 0;
    return game.main(number, a[0], a[1], a[2], a[3], a[4], a[5], a[6], a[7], a[8], a[9], a[10], a[11]);
}

void game_client_command(int slot, const char* const* words, int count) {
    const int arguments[game_call_arguments] = {slot};
    command.words = words;
    command.count = count < max_words ? count : max_words;
    (void)game_call(GAME_CLIENT_COMMAND, arguments);
    command.words = NULL;
}

bool game_answer_argument(intptr_t number, const intptr_t arguments[engine_call_arguments],
                          intptr_t* result) {
    if (command.words == NULL) return false;
    if (number == ENGINE_ARGC) {
        *result = command.count;
        return true;
    }
    if (number != ENGINE_ARGV) return false;
    const int index = (int)arguments[0], size = (int)arguments[2];
    if (arguments[1] != 0 && size > 0) {
        snprintf((char*)arguments[1], (size_t)size, "%s",
                 index >= 0 && index < command.count ? command.words[index] : "");
    }
    *result = 0;
    return true;
}
