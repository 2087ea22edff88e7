/* SPDX-License-Identifier: GPL-2.0-or-later */
#include "settings.h"

#include <stdio.h>
#include <string.h>

#include "engine.h"
#include "game/setting.h"

enum { default_port = 27960, default_rate_hz = 20 };

static const struct {
    const char *name, *value;
    enum cvar_access access;
} cvars[] = {
    {"director_enable", "1", cvar_open},
    {"director_match", "", cvar_open},
    {"director_domain", "0", cvar_open},
    {"director_interface", "lo", cvar_open},
    {"director_directors", "127.0.0.1", cvar_open},
    {"director_spectate", "1", cvar_open},
    {"director_profile", "", cvar_open},
    {"director_record", "", cvar_open},
    {"director_game", "", cvar_set_at_start}, /* code: nothing for whoever has the remote console */
};

void settings_register(void) {
    for (size_t i = 0; i < sizeof cvars / sizeof *cvars; ++i) {
        engine_cvar_register(cvars[i].name, cvars[i].value, cvars[i].access);
    }
}

static uint32_t read_domain(struct settings* settings) {
    static const char name[] = "director_domain";
    char text[32];
    engine_cvar_string(name, text, sizeof text);
    return setting_domain(name, text, settings->match.error, sizeof settings->match.error);
}

static void read_text(struct settings* settings, const char* name, char* text, size_t size) {
    enum { longest = 256 }; /* of the engine's cvars */
    char value[longest];
    engine_cvar_string(name, value, sizeof value);
    setting_text(text, size, name, value, settings->match.error, sizeof settings->match.error);
}

bool settings_read(struct settings* settings) {
    struct settings now;
    memset(&now, 0, sizeof now); /* compared as bytes: an assignment need not keep the padding */
    now.match.enabled = engine_cvar_integer("director_enable") != 0;
    now.spectate = now.match.enabled && engine_cvar_integer("director_spectate") != 0;
    now.match.domain = read_domain(&now);
    const int rate = engine_cvar_integer("sv_fps");
    now.match.rate_hz = (float)(rate > 0 ? rate : default_rate_hz);
    read_text(&now, "director_match", now.match.match_id, sizeof now.match.match_id);
    if (now.match.match_id[0] == '\0') {
        const int port = engine_cvar_integer("net_port");
        snprintf(now.match.match_id, sizeof now.match.match_id, "openarena-%d",
                 port > 0 ? port : default_port);
    }
    read_text(&now, "director_interface", now.match.network_interface, sizeof now.match.network_interface);
    read_text(&now, "director_directors", now.match.directors, sizeof now.match.directors);
    read_text(&now, "director_profile", now.profile, sizeof now.profile);
    read_text(&now, "director_record", now.record, sizeof now.record);
    if (memcmp(&now, settings, sizeof now) == 0) return false;
    memcpy(settings, &now, sizeof now);
    return true;
}
