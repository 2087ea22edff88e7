/* SPDX-License-Identifier: GPL-2.0-or-later */
#include "overlay.h"

void overlay_show_camera(struct overlay* overlay, int slot, int32_t level_time, const struct view* view,
                         bool cut) {
    static const int32_t health = 100, constant_spawn_count = 1, no_ground = 1023;
    /* As in free flight: a client spreads a change of the view height over 100 ms, even at a cut. */
    static const int32_t view_height = 26;
    uint8_t* const state = overlay->camera;
    if (cut || !overlay->active) overlay->teleport_bit ^= EFLAG_TELEPORT;
    overlay->active = true;
    memset(state, 0, player_state_size);
    write_int(state, PS_COMMAND_TIME, level_time);
    write_int(state, PS_PM_TYPE, PM_SPECTATOR);
    /* A follower's view is drawn as sent. The slot's own number: the client leaves out the followed player.
     */
    write_int(state, PS_PM_FLAGS, PM_FLAG_FOLLOW);
    write_int(state, PS_CLIENT_NUMBER, slot);
    const float origin[3] = {view->position[0], view->position[1], view->position[2] - (float)view_height};
    write_vector(state, PS_ORIGIN, origin);
    write_int(state, PS_VIEW_HEIGHT, view_height);
    write_vector(state, PS_VIEW_ANGLES, view->angles);
    write_int(state, PS_GROUND_ENTITY, no_ground);
    write_int(state, PS_EFLAGS, overlay->teleport_bit);
    write_int(state, PS_STATS + 4 * STAT_HEALTH, health);
    write_int(state, PS_STATS + 4 * STAT_MAX_HEALTH, health);
    write_int(state, PS_PERSISTANT + 4 * PERSISTANT_TEAM, team_spectator);
    write_int(state, PS_PERSISTANT + 4 * PERSISTANT_SPAWN_COUNT, constant_spawn_count);
}

static void write_teleport_bit(uint8_t* state, int32_t bit) {
    write_int(state, PS_EFLAGS, (read_int(state, PS_EFLAGS) & ~(int32_t)EFLAG_TELEPORT) | bit);
}

void overlay_show_own(struct overlay* overlay, int slot, uint8_t* own) {
    /* The client cuts by itself when the number changes, as it does to a followed player. */
    const bool same_number = read_int(own, PS_CLIENT_NUMBER) == slot;
    if (overlay->active && same_number) write_teleport_bit(own, overlay->teleport_bit ^ EFLAG_TELEPORT);
    overlay->teleport_bit = read_int(own, PS_EFLAGS) & EFLAG_TELEPORT;
    overlay->active = false;
}

void overlay_prepare_spawn(const struct overlay* overlay, uint8_t* own) {
    if (overlay->active) write_teleport_bit(own, overlay->teleport_bit);
}

static bool is_watching(const uint8_t* state) {
    const bool follows = (read_int(state, PS_PM_FLAGS) & PM_FLAG_FOLLOW) != 0;
    const int32_t type = read_int(state, PS_PM_TYPE);
    return type != PM_INTERMISSION && (follows || type == PM_SPECTATOR);
}

void overlay_put_on(struct overlay* overlay, uint8_t* state) {
    if (overlay->on || !overlay->active || !is_watching(state)) return;
    memcpy(overlay->own, state, player_state_size);
    memcpy(state, overlay->camera, player_state_size);
    write_int(state, PS_PING, read_int(overlay->own, PS_PING));
    overlay->on = true;
}

void overlay_take_off(struct overlay* overlay, uint8_t* state) {
    if (!overlay->on) return;
    const int32_t ping = read_int(state, PS_PING);
    memcpy(state, overlay->own, player_state_size);
    write_int(state, PS_PING, ping);
    overlay->on = false;
}
