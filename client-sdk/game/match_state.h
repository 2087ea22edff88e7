/* SPDX-License-Identifier: Apache-2.0 */
/* What a game server wants to publish: plain values without padding, which may be compared as bytes. */
#ifndef CAMERA_DIRECTOR_GAME_MATCH_STATE_H
#define CAMERA_DIRECTOR_GAME_MATCH_STATE_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { match_max_players = 64 };

/* From the server's cvars. */
struct match_settings {
    uint32_t enabled; /* 0: nothing is published */
    uint32_t domain;  /* DDS domain, 0 .. 230; UINT32_MAX when that is no number */
    float rate_hz;    /* pose frames per second; finite and above 0, unless error says otherwise */
    char match_id[64];
    char network_interface[64]; /* name or address */
    char directors[256];        /* addresses, separated by commas */
    char error[128];            /* what is wrong with them: nothing is published; "" = nothing is wrong */
};

struct match_player {
    uint8_t in_use; /* all else is 0 otherwise */
    uint8_t team;
    char name[64];
};

/* Of one life of the game, which is one map. */
struct match_state {
    uint32_t life; /* counts them from 1 */
    char map[64];  /* the map's name in the director's configuration */
    struct match_settings settings;
    struct match_player players[match_max_players]; /* the player of id i in place i */
};

#ifdef __cplusplus
}
#endif

#endif
