/* SPDX-License-Identifier: GPL-2.0-or-later */
#include "overlay.h"

/* How long a cut to the game's own view stays declared, for clients that take few snapshots or lose some. */
static const int32_t cut_duration = 1000;

void overlay_show_camera(struct overlay* overlay, int slot, int32_t level_time, const struct view* view,
                         bool cut) {
    static const int32_t health = 100, constant_spawn_count = 1, no_ground = 1023;
    uint8_t* const state = overlay->camera;
    if (cut || overlay->kind != overlay_camera) overlay->teleport_bit ^= EFLAG_TELEPORT;
    overlay->kind = overlay_camera;
    memset(state, 0, player_state_size);
    write_int(state, PS_COMMAND_TIME, level_time);
    write_int(state, PS_PM_TYPE, PM_SPECTATOR);
    /* A follower's view is drawn as sent. The slot's own number: the client leaves out the followed player.
     */
    write_int(state, PS_PM_FLAGS, PM_FLAG_FOLLOW);
    write_int(state, PS_CLIENT_NUMBER, slot);
    write_vector(state, PS_ORIGIN, view->position);
    write_vector(state, PS_VIEW_ANGLES, view->angles);
    write_int(state, PS_GROUND_ENTITY, no_ground);
    write_int(state, PS_EFLAGS, overlay->teleport_bit);
    write_int(state, PS_STATS + 4 * STAT_HEALTH, health);
    write_int(state, PS_STATS + 4 * STAT_MAX_HEALTH, health);
    write_int(state, PS_PERSISTANT + 4 * PERSISTANT_TEAM, team_spectator);
    write_int(state, PS_PERSISTANT + 4 * PERSISTANT_SPAWN_COUNT, constant_spawn_count);
}

void overlay_show_own(struct overlay* overlay, int slot, int32_t level_time, const uint8_t* own) {
    const int32_t bit = read_int(own, PS_EFLAGS) & EFLAG_TELEPORT;
    /* The client cuts by itself when the number changes, as it does to a followed player. */
    const bool same_number = read_int(own, PS_CLIENT_NUMBER) == slot;
    if (overlay->kind == overlay_camera) {
        overlay->kind = same_number && bit == overlay->teleport_bit ? overlay_cut : overlay_none;
        overlay->cut_end = level_time + cut_duration;
    } else if (overlay->kind == overlay_cut && (!same_number || level_time >= overlay->cut_end)) {
        overlay->kind = overlay_none;
    }
    overlay->teleport_bit = overlay->kind == overlay_cut ? bit ^ EFLAG_TELEPORT : bit;
}

static bool may_show(enum overlay_kind kind, const uint8_t* state) {
    const bool follows = (read_int(state, PS_PM_FLAGS) & PM_FLAG_FOLLOW) != 0;
    const int32_t type = read_int(state, PS_PM_TYPE);
    if (type == PM_INTERMISSION) return kind == overlay_cut;
    return kind != overlay_none && (follows || type == PM_SPECTATOR);
}

void overlay_put_on(struct overlay* overlay, uint8_t* state) {
    if (overlay->on || !may_show(overlay->kind, state)) return;
    memcpy(overlay->own, state, player_state_size);
    if (overlay->kind == overlay_camera) {
        memcpy(state, overlay->camera, player_state_size);
        write_int(state, PS_PING, read_int(overlay->own, PS_PING));
    } else {
        write_int(state, PS_EFLAGS, read_int(state, PS_EFLAGS) ^ EFLAG_TELEPORT);
    }
    overlay->on = true;
}

void overlay_take_off(struct overlay* overlay, uint8_t* state) {
    if (!overlay->on) return;
    const int32_t ping = read_int(state, PS_PING);
    memcpy(state, overlay->own, player_state_size);
    write_int(state, PS_PING, ping);
    overlay->on = false;
}
