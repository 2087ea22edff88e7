/* SPDX-License-Identifier: GPL-2.0-or-later */
#include "poses.h"

#include <math.h>
#include <string.h>

#include "engine.h"

static bool all_finite(const float vector[3]) {
    return isfinite(vector[0]) && isfinite(vector[1]) && isfinite(vector[2]);
}

struct player_pose pose_of(const uint8_t* player_state, const struct match_player* entry, bool bot) {
    struct player_pose pose, absent;
    memset(&pose, 0, sizeof pose);
    memset(&absent, 0, sizeof absent);
    if (!entry->in_use || read_element(player_state, PS_PERSISTANT, PERSISTANT_SPAWN_COUNT) <= 0)
        return absent;
    const int32_t type = read_int(player_state, PS_PM_TYPE);
    const int32_t health = read_element(player_state, PS_STATS, STAT_HEALTH);
    const int32_t viewheight = read_int(player_state, PS_VIEW_HEIGHT);
    pose.in_game = 1;
    pose.bot = bot;
    /* A follower's playerState is a copy of its target's. */
    pose.spectator = entry->team == team_spectator || type == PM_SPECTATOR || type == PM_INTERMISSION ||
                     (read_int(player_state, PS_PM_FLAGS) & PM_FLAG_FOLLOW) != 0;
    pose.alive = !pose.spectator && type != PM_DEAD && health > 0;
    pose.teleport_bit = (read_int(player_state, PS_EFLAGS) & EFLAG_TELEPORT) != 0;
    pose.team = entry->team;
    pose.weapon = (uint8_t)read_int(player_state, PS_WEAPON);
    pose.viewheight = (int16_t)viewheight;
    pose.health = (int16_t)health;
    read_vector(pose.origin, player_state, PS_ORIGIN);
    read_vector(pose.velocity, player_state, PS_VELOCITY);
    read_vector(pose.angles, player_state, PS_VIEW_ANGLES);
    return all_finite(pose.origin) && all_finite(pose.velocity) && all_finite(pose.angles) ? pose : absent;
}

void poses_sample(struct player_pose poses[max_slots]) {
    for (int slot = 0; slot < max_slots; ++slot) {
        const struct match_player* entry = roster_at(slot);
        if (!entry->in_use) {
            memset(&poses[slot], 0, sizeof poses[slot]);
            continue;
        }
        const bool bot = (read_int(engine_entity(slot), ENTITY_SERVER_FLAGS) & ENTITY_BOT) != 0;
        poses[slot] = pose_of(engine_player_state(slot), entry, bot);
    }
}

void pose_eye(float eye[3], const struct player_pose* pose) {
    memcpy(eye, pose->origin, 3 * sizeof *eye);
    eye[2] += pose->viewheight;
}

bool pose_jumped(const struct player_pose* before, const struct player_pose* now) {
    return !before->in_game || before->spectator != now->spectator ||
           before->teleport_bit != now->teleport_bit;
}
