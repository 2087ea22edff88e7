/* SPDX-License-Identifier: GPL-2.0-or-later */
/* The module's cvars. */
#ifndef CAMERA_DIRECTOR_OPENARENA_SETTINGS_H
#define CAMERA_DIRECTOR_OPENARENA_SETTINGS_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

struct settings {
    uint8_t enable;      /* director_enable: poses are published */
    uint8_t spectate;    /* director_spectate, and enable: spectators get the director's camera */
    uint32_t domain;     /* director_domain: DDS domain; UINT32_MAX when that is no number */
    int32_t rate_hz;     /* sv_fps */
    char match[64];      /* director_match: match id */
    char interface[64];  /* director_interface: name or address of the network interface */
    char directors[256]; /* director_directors: addresses */
    char profile[32];    /* director_profile: of spectators who have chosen none */
    char record[256];    /* director_record: path prefix of recordings; "" = none */
    char error[128];     /* what is wrong with them; "" = nothing */
};

void settings_register(void);
/* Reads the cvars. Returns true when a value differs from what `settings` holds. */
bool settings_read(struct settings* settings);

#ifdef __cplusplus
}
#endif

#endif
