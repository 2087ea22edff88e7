/* SPDX-License-Identifier: GPL-2.0-or-later */
/* The module's cvars. */
#ifndef CAMERA_DIRECTOR_OPENARENA_SETTINGS_H
#define CAMERA_DIRECTOR_OPENARENA_SETTINGS_H

#include <stdbool.h>
#include <stdint.h>

#include "game/match_state.h"

#ifdef __cplusplus
extern "C" {
#endif

struct settings {
    /* director_enable, director_domain, sv_fps, director_match, director_interface, director_directors; and
     * what is wrong with any of the module's cvars. */
    struct match_settings match;
    uint8_t spectate; /* director_spectate, and director_enable: spectators get the director's camera */
    char profile[32]; /* director_profile: of spectators who have chosen none */
    char record[256]; /* director_record: path prefix of recordings; "" = none */
};

void settings_register(void);
/* Reads the cvars. Returns true when a value differs from what `settings` holds. */
bool settings_read(struct settings* settings);

#ifdef __cplusplus
}
#endif

#endif
