/* SPDX-License-Identifier: GPL-2.0-or-later */
#include "settings.h"

#include <stdio.h>
#include <string.h>

#include "engine.h"

enum { max_domain = 230, default_port = 27960 };

static const struct {
    const char *name, *value;
} cvars[] = {
    {"director_enable", "1"},
    {"director_match", ""},
    {"director_domain", "0"},
    {"director_interface", "lo"},
    {"director_directors", "127.0.0.1"},
    {"director_spectate", "1"},
    {"director_profile", ""},
    {"director_record", ""},
    {"director_game", ""},
};

void settings_register(void) {
    for (size_t i = 0; i < sizeof cvars / sizeof *cvars; ++i) {
        engine_cvar_register(cvars[i].name, cvars[i].value);
    }
}

bool settings_read(struct settings* settings) {
    struct settings now;
    memset(&now, 0, sizeof now); /* compared as bytes */
    now.enable = engine_cvar_integer("director_enable") != 0;
    now.spectate = engine_cvar_integer("director_spectate") != 0;
    const int domain = engine_cvar_integer("director_domain");
    now.domain = domain < 0 || domain > max_domain ? 0u : (uint32_t)domain;
    engine_cvar_string("director_match", now.match, sizeof now.match);
    if (now.match[0] == '\0') {
        const int port = engine_cvar_integer("net_port");
        snprintf(now.match, sizeof now.match, "openarena-%d", port > 0 ? port : default_port);
    }
    engine_cvar_string("director_interface", now.interface, sizeof now.interface);
    engine_cvar_string("director_directors", now.directors, sizeof now.directors);
    engine_cvar_string("director_profile", now.profile, sizeof now.profile);
    engine_cvar_string("director_record", now.record, sizeof now.record);
    if (memcmp(&now, settings, sizeof now) == 0) return false;
    *settings = now;
    return true;
}
