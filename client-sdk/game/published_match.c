/* SPDX-License-Identifier: Apache-2.0 */
#include "game/published_match.h"

#include <stdio.h>
#include <string.h>

#include "game/thread.h"

static const int64_t retry_interval = 1000000000;
static const int64_t watch_interval = 500000000; /* between looks at the number of directors */
static const int64_t longest_change_of_map = 60000000000;

void published_match_close(struct published_match* match) {
    if (match->open) (void)cdir_context_close(match->context);
    match->open = false;
    match->epoch = 0;
    match->directors = 0;
}

void published_match_fail(struct published_match* match, int64_t now) {
    snprintf(match->error, sizeof match->error, "%s", cdir_last_error());
    published_match_close(match);
    match->retry_time = now + retry_interval;
}

static uint32_t list_players(cdir_player listed[match_max_players],
                             const struct match_player players[match_max_players]) {
    uint32_t count = 0;
    for (uint32_t id = 0; id < match_max_players; ++id) {
        if (!players[id].in_use) continue;
        cdir_player* player = &listed[count++];
        *player = cdir_player_default();
        player->id = id;
        player->team = players[id].team;
        snprintf(player->name, sizeof player->name, "%s", players[id].name);
    }
    return count;
}

static cdir_status open_context(struct published_match* match) {
    const struct match_settings* settings = &match->wanted.settings;
    cdir_context_options options = cdir_context_options_default();
    options.domain = settings->domain;
    options.network_interface = settings->network_interface;
    options.directors = settings->directors;
    const cdir_status status = cdir_context_open(&options, &match->context);
    match->open = status >= 0;
    if (match->open) worker_thread_stop_before_contexts();
    return status;
}

/* new_life: since the match was opened, or described last. */
static cdir_status describe(struct published_match* match, bool new_life) {
    const struct match_state* wanted = &match->wanted;
    cdir_match_info info = cdir_match_info_default();
    info.rate_hz = wanted->settings.rate_hz;
    snprintf(info.match_id, sizeof info.match_id, "%s", wanted->settings.match_id);
    snprintf(info.map_name, sizeof info.map_name, "%s", wanted->map);
    cdir_player players[match_max_players];
    const uint32_t count = list_players(players, wanted->players);
    if (match->open)
        return (new_life ? cdir_match_restart : cdir_match_update)(match->handle, &info, players, count);
    const cdir_status status = open_context(match);
    return status < 0 ? status : cdir_match_open(match->context, &info, players, count, &match->handle);
}

static void announce(struct published_match* match, bool new_life, int64_t now) {
    const struct match_settings* settings = &match->wanted.settings;
    match->retry_time = 0;
    snprintf(match->error, sizeof match->error, "%s", settings->enabled ? settings->error : "");
    if (!settings->enabled || settings->error[0] != '\0') {
        published_match_close(match);
    } else if (describe(match, new_life) < 0 || cdir_match_epoch(match->handle, &match->epoch) < 0) {
        published_match_fail(match, now);
    }
}

static bool is_reached_alike(const struct match_settings* a, const struct match_settings* b) {
    return a->domain == b->domain && strcmp(a->match_id, b->match_id) == 0 &&
           strcmp(a->network_interface, b->network_interface) == 0 && strcmp(a->directors, b->directors) == 0;
}

void published_match_want(struct published_match* match, const struct match_state* wanted, int64_t now) {
    const bool new_life = match->wanted.life != wanted->life;
    const bool same_settings =
        memcmp(&match->wanted.settings, &wanted->settings, sizeof wanted->settings) == 0;
    if (!is_reached_alike(&match->wanted.settings, &wanted->settings)) published_match_close(match);
    match->wanted = *wanted;
    match->in_life = true;
    if (match->retry_time == 0 || new_life || !same_settings) announce(match, new_life, now);
}

void published_match_end_life(struct published_match* match, int64_t now) {
    match->in_life = false;
    match->retry_time = 0;
    match->life_end_time = now;
}

static void watch_directors(struct published_match* match, int64_t now) {
    const uint32_t before = match->directors;
    match->watch_time = now + watch_interval;
    if (cdir_match_director_count(match->handle, &match->directors) < 0) match->directors = 0;
    if (match->directors > 0 || before == 0) return;
    published_match_close(match);
    if (match->in_life) announce(match, false, now);
}

void published_match_look_after(struct published_match* match, int64_t now) {
    if (match->retry_time != 0 && now >= match->retry_time) announce(match, false, now);
    if (!match->open) return;
    if (!match->in_life && now >= match->life_end_time + longest_change_of_map) {
        published_match_close(match);
    } else if (now >= match->watch_time) {
        watch_directors(match, now);
    }
}
