/* SPDX-License-Identifier: Apache-2.0 */
/* A game's match as the directors know it, over the game's lives and changes of its settings. On one thread.
 */
#ifndef CAMERA_DIRECTOR_GAME_PUBLISHED_MATCH_H
#define CAMERA_DIRECTOR_GAME_PUBLISHED_MATCH_H

#include <camera_director/camera_director.h>
#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

/* All 0 = closed. */
struct published_match {
    bool open;
    cdir_context context;
    cdir_match handle;
    uint64_t epoch;

    /* As announced. */
    uint32_t life, domain;
    char match_id[64], network_interface[64], directors[256];
};

/* Opens the match, begins a new epoch where `life` differs from before, or updates its description. Opens it
 * anew where it has another id or must be reached otherwise. Of the options cyclone_xml is null; info.epoch
 * is 0. Returns false when that failed: it is closed then, and cdir_last_error() says why. */
bool published_match_announce(struct published_match* published, const cdir_context_options* options,
                              uint32_t life, const cdir_match_info* info, const cdir_player* players,
                              uint32_t player_count);
/* That receive the poses now; 0 while closed. */
uint32_t published_match_directors(const struct published_match* published);
/* Closes the context, too, with the observers that were opened in it. */
void published_match_close(struct published_match* published);

#ifdef __cplusplus
}
#endif

#endif
