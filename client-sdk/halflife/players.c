#include "players.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

/* Further than any lift moves a player in a frame without a velocity of the player's own. */
static const float lift_distance = 64.0f;

struct previous_pose {
    bool present, alive, view_set;
    double time;
    float origin[3], velocity[3];
};

static struct previous_pose previous_poses[max_players];
static float previous_health[max_players]; /* 0: not in the game, or dead */

void players_forget_poses(void) {
    memset(previous_poses, 0, sizeof previous_poses);
}

void players_reset(void) {
    players_forget_poses();
    memset(previous_health, 0, sizeof previous_health);
}

static int player_limit(const struct entity_list* list) {
    return list->max_clients < max_players ? list->max_clients : (int)max_players;
}

/* Null: nobody with this id is in the game. */
static const struct entity_variables* find_player(const struct entity_list* list, int id) {
    if (id >= list->count) return NULL;
    const struct entity* entity = engine_entity(id);
    if (entity == NULL || entity->free != 0 || entity->game_data == NULL) return NULL;
    const struct entity_variables* variables = &entity->variables;
    const bool named = engine_text(variables->player_name)[0] != '\0';
    return named && (variables->flags & entity_client) != 0 ? variables : NULL;
}

static bool spectates(const struct entity_variables* player) {
    return player->observer_mode != 0 || (player->flags & (entity_spectator | entity_proxy)) != 0;
}

static bool is_alive(const struct entity_variables* player) {
    return player->dead == 0 && player->health > 0.0f && !spectates(player);
}

uint32_t players_id(const struct entity_list* list, const struct entity* entity) {
    const uintptr_t first = (uintptr_t)list->first;
    const uintptr_t address = (uintptr_t)entity;
    if (first == 0 || address <= first || (address - first) % sizeof *entity != 0) return CDIR_NO_PLAYER;
    const uintptr_t index = (address - first) / sizeof *entity;
    return index <= (uintptr_t)player_limit(list) ? (uint32_t)index : CDIR_NO_PLAYER;
}

void players_identify(const struct entity_list* list, struct match_player players[match_max_players]) {
    memset(players, 0, match_max_players * sizeof *players);
    for (int id = 1; id <= player_limit(list); ++id) {
        const struct entity_variables* found = find_player(list, id);
        if (found == NULL) continue;
        struct match_player* player = &players[id];
        player->in_use = 1;
        player->team = (uint8_t)found->team;
        strncpy(player->name, engine_text(found->player_name), sizeof player->name - 1);
    }
}

static bool all_finite(const float* values, int count) {
    for (int i = 0; i < count; ++i)
        if (!isfinite(values[i])) return false;
    return true;
}

static float length(const float* vector) {
    return sqrtf(vector[0] * vector[0] + vector[1] * vector[1] + vector[2] * vector[2]);
}

static bool is_discontinuous(const struct previous_pose* previous, const struct previous_pose* now) {
    if (!previous->present || (now->alive && !previous->alive) || (now->view_set && !previous->view_set))
        return true;
    const float moved[3] = {now->origin[0] - previous->origin[0], now->origin[1] - previous->origin[1],
                            now->origin[2] - previous->origin[2]};
    const float seconds = (float)(now->time - previous->time);
    return length(moved) > fmaxf(length(previous->velocity), length(now->velocity)) * seconds + lift_distance;
}

/* Returns false where something of it is no number: a game's bug must not cost all players their frame. */
static bool place(const struct entity_variables* player, struct player_pose* pose) {
    for (int i = 0; i < 3; ++i)
        pose->eye[i] = player->origin[i] + player->view_offset[i];
    memcpy(pose->velocity, player->velocity, sizeof pose->velocity);
    memcpy(pose->angles, player->view_angles, sizeof pose->angles);
    return all_finite(player->origin, 3) && all_finite(pose->eye, 3) && all_finite(pose->velocity, 3) &&
           all_finite(pose->angles, 3);
}

void players_sample(const struct entity_list* list, double time, struct server_frame* frame) {
    frame->player_count = 0;
    for (int id = 1; id <= player_limit(list); ++id) {
        struct previous_pose* previous = &previous_poses[id - 1];
        const struct entity_variables* player = find_player(list, id);
        struct player_pose* pose = &frame->players[frame->player_count];
        if (player == NULL || !place(player, pose)) {
            previous->present = false;
            continue;
        }
        ++frame->player_count;
        struct previous_pose now = {
            .present = true, .alive = is_alive(player), .view_set = player->fix_angles != 0, .time = time};
        memcpy(now.origin, player->origin, sizeof now.origin);
        memcpy(now.velocity, player->velocity, sizeof now.velocity);
        pose->id = (uint32_t)id;
        pose->flags = (now.alive ? CDIR_POSE_ALIVE : 0u) | (spectates(player) ? CDIR_POSE_SPECTATOR : 0u) |
                      (is_discontinuous(previous, &now) ? CDIR_POSE_DISCONTINUITY : 0u);
        *previous = now;
    }
}

/* Who caused a player's last damage. */
static uint32_t attacker(const struct entity_list* list, const struct entity_variables* player) {
    const struct entity* inflictor = player->damage_inflictor;
    const uint32_t id = players_id(list, inflictor);
    if (id != CDIR_NO_PLAYER) return id;
    /* The game's pointer may be stale: look only inside the list. */
    const uintptr_t first = (uintptr_t)list->first;
    const uintptr_t address = (uintptr_t)inflictor;
    const uintptr_t size = (uintptr_t)list->count * sizeof *inflictor;
    if (address < first || address - first >= size || (address - first) % sizeof *inflictor != 0)
        return CDIR_NO_PLAYER;
    return players_id(list, inflictor->variables.owner);
}

void players_damage(const struct entity_list* list, void (*add)(const struct game_event* event)) {
    for (int id = 1; id <= player_limit(list); ++id) {
        const struct entity_variables* player = find_player(list, id);
        const bool has_health = player != NULL && isfinite(player->health) && !spectates(player);
        const float health = has_health ? fmaxf(player->health, 0.0f) : 0.0f;
        const float lost = previous_health[id - 1] - health;
        previous_health[id - 1] = health;
        if (!has_health || lost <= 0.0f) continue;
        const struct game_event event = {.kind = CDIR_EVENT_DAMAGE,
                                         .actor = attacker(list, player),
                                         .subject = (uint32_t)id,
                                         .value = lost};
        add(&event);
    }
}
