/* SPDX-License-Identifier: GPL-2.0-or-later */
#include "puppets.h"

#include <math.h>
#include <stdio.h>

#include "engine.h"
#include "frame.h"
#include "trajectory.h"

static const char* const models[] = {"sarge",   "gargoyle", "penguin",  "sergei",
                                     "kyonshi", "tony",     "angelyss", "rai"};
enum { model_count = sizeof models / sizeof *models };

/* Fields of entityState_t that only a puppet needs. */
enum {
    ENTITY_EFLAGS = 8,
    ENTITY_MOVEMENT_DIRECTION = 132,
    ENTITY_GROUND = 148,
    ENTITY_EVENT = 180,
    ENTITY_POWERUPS = 188,
    ENTITY_WEAPON = 192,
    ENTITY_LEGS = 196,
    ENTITY_TORSO = 200
};
enum { type_player = 1, type_invisible = 10, EFLAG_DEAD = 1, no_ground = 1023, gibbed_health = -40 };
/* Animations of a player's model. */
enum {
    both_death = 0,
    torso_stand = 11,
    legs_walk_crouched = 13,
    legs_run = 15,
    legs_back = 16,
    legs_jump = 18,
    legs_idle = 22,
    legs_idle_crouched = 23
};

static const float run_speed = 20.0f, jump_speed = 120.0f; /* units/s from which it looks like that */
enum { crouched_viewheight = 12 };

static bool is_puppet(int slot) {
    const uint8_t* const entity = engine_entity(slot);
    return read_int(entity, ENTITY_IN_USE) != 0 && (read_int(entity, ENTITY_SERVER_FLAGS) & ENTITY_BOT) != 0;
}

static size_t count_puppets(void) {
    size_t count = 0;
    for (int slot = 0; slot < max_slots; ++slot)
        count += is_puppet(slot);
    return count;
}

bool puppets_can_stand(void) {
    return count_puppets() > 0;
}

bool puppets_enter(const struct take* take) {
    const size_t count = count_puppets();
    if (count >= take->poses.track_count) return true;
    char line[64];
    snprintf(line, sizeof line, "addbot %s 1 free 0 \"Player %d\"\n", models[count % model_count],
             take->poses.tracks[count].player);
    engine_enter_command(line);
    return false;
}

static bool stands(const struct recorded_pose* pose) {
    return hypotf(pose->velocity[0], pose->velocity[1]) < run_speed;
}

/* Of the legs: eighths of a turn, counterclockwise from where the player looks. */
static int movement_direction(const struct recorded_pose* pose) {
    if (stands(pose)) return 0;
    const double yaw = pose->angles[1] * 0.017453292519943295;
    const double eighths = (atan2(pose->velocity[1], pose->velocity[0]) - yaw) / 0.7853981633974483;
    return (int)(((long)floor(eighths + 0.5) % 8 + 8) % 8);
}

static int legs_of(const struct recorded_pose* pose, int direction) {
    const bool crouched = pose->viewheight <= crouched_viewheight;
    if (fabsf(pose->velocity[2]) > jump_speed) return legs_jump;
    if (stands(pose)) return crouched ? legs_idle_crouched : legs_idle;
    if (crouched) return legs_walk_crouched;
    return direction >= 3 && direction <= 5 ? legs_back : legs_run;
}

static void write_pose(uint8_t* entity, const struct recorded_pose* pose) {
    static const float no_turn[3] = {0, 0, 0};
    const bool seen = pose->present && pose->health > gibbed_health;
    const int direction = movement_direction(pose);
    const bool in_air = fabsf(pose->velocity[2]) > jump_speed;
    write_int(entity, ENTITY_TYPE, seen ? type_player : type_invisible);
    write_int(entity, ENTITY_EVENT, 0);
    write_int(entity, ENTITY_POWERUPS, 0);
    if (!seen) return;
    write_int(entity, ENTITY_EFLAGS,
              (pose->alive ? 0 : EFLAG_DEAD) | (pose->teleport_bit != 0 ? EFLAG_TELEPORT : 0));
    write_trajectory(entity, ENTITY_POSITION, pose->origin, pose->velocity);
    write_trajectory(entity, ENTITY_ROTATION, pose->angles, no_turn);
    const float sideways = (float)direction;
    memcpy(entity + ENTITY_MOVEMENT_DIRECTION, &sideways, sizeof sideways);
    write_int(entity, ENTITY_GROUND, in_air ? no_ground : ENTITY_NUMBER_WORLD);
    write_int(entity, ENTITY_WEAPON, pose->weapon);
    write_int(entity, ENTITY_LEGS, pose->alive ? legs_of(pose, direction) : both_death);
    write_int(entity, ENTITY_TORSO, pose->alive ? torso_stand : both_death);
    /* What is sent is chosen by where the entity is linked. */
    write_vector(entity, ENTITY_ORIGIN, pose->origin);
    engine_link_entity(entity);
}

void puppets_pose(const struct take* take, double time) {
    size_t index = 0;
    for (int slot = 0; slot < max_slots && index < take->poses.track_count; ++slot) {
        if (!is_puppet(slot)) continue;
        const struct recorded_pose pose = take_pose(take, index++, time);
        write_pose(engine_mutable_entity(slot), &pose);
    }
}
