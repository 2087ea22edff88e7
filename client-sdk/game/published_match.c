/* SPDX-License-Identifier: Apache-2.0 */
#include "game/published_match.h"

#include <stdio.h>
#include <string.h>

static bool is_reached_by(const struct published_match* published, const cdir_context_options* options,
                          const cdir_match_info* info) {
    return published->domain == options->domain && strcmp(published->match_id, info->match_id) == 0 &&
           strcmp(published->network_interface, options->network_interface) == 0 &&
           strcmp(published->directors, options->directors) == 0;
}

static cdir_status open_match(struct published_match* published, const cdir_context_options* options,
                              const cdir_match_info* info, const cdir_player* players,
                              uint32_t player_count) {
    cdir_status status = cdir_context_open(options, &published->context);
    if (status < 0) return status;
    published->open = true;
    published->domain = options->domain;
    snprintf(published->match_id, sizeof published->match_id, "%s", info->match_id);
    snprintf(published->network_interface, sizeof published->network_interface, "%s",
             options->network_interface);
    snprintf(published->directors, sizeof published->directors, "%s", options->directors);
    return cdir_match_open(published->context, info, players, player_count, &published->handle);
}

bool published_match_announce(struct published_match* published, const cdir_context_options* options,
                              uint32_t life, const cdir_match_info* info, const cdir_player* players,
                              uint32_t player_count) {
    cdir_status status;
    if (published->open && !is_reached_by(published, options, info)) published_match_close(published);
    if (!published->open) {
        status = open_match(published, options, info, players, player_count);
    } else if (published->life != life) {
        status = cdir_match_restart(published->handle, info, players, player_count);
    } else {
        status = cdir_match_update(published->handle, info, players, player_count);
    }
    if (status >= 0) status = cdir_match_epoch(published->handle, &published->epoch);
    if (status < 0) published_match_close(published);
    published->life = life;
    return status >= 0;
}

uint32_t published_match_directors(const struct published_match* published) {
    uint32_t count = 0;
    if (published->open && cdir_match_director_count(published->handle, &count) < 0) return 0;
    return count;
}

void published_match_close(struct published_match* published) {
    if (published->open) (void)cdir_context_close(published->context);
    published->open = false;
}
