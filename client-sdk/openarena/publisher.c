/* SPDX-License-Identifier: GPL-2.0-or-later */
#include "publisher.h"

#include <stdio.h>
#include <string.h>

#include "poses.h"

static const int64_t ns_per_ms = 1000000;

static bool send_poses(struct publisher* publisher, const struct server_frame* frame) {
    uint32_t ids[max_slots], flags[max_slots], count = 0;
    float eyes[3 * max_slots], orientations[4 * max_slots], velocities[3 * max_slots];
    for (uint32_t slot = 0; slot < max_slots; ++slot) {
        const struct player_pose* pose = &frame->players[slot];
        if (!pose->in_game) continue;
        const bool jumped =
            publisher->last_life != frame->life || pose_jumped(&publisher->last_poses[slot], pose);
        ids[count] = slot;
        flags[count] = (pose->alive ? CDIR_POSE_ALIVE : 0u) | (pose->spectator ? CDIR_POSE_SPECTATOR : 0u) |
                       (jumped ? CDIR_POSE_DISCONTINUITY : 0u);
        pose_eye(eyes + 3 * count, pose);
        (void)cdir_orientation_from_angles(pose->angles, orientations + 4 * count);
        memcpy(velocities + 3 * count, pose->velocity, sizeof pose->velocity);
        ++count;
    }
    publisher->last_life = frame->life;
    memcpy(publisher->last_poses, frame->players, sizeof publisher->last_poses);
    cdir_pose_frame poses = cdir_pose_frame_default();
    poses.frame_time = frame->level_time * ns_per_ms;
    poses.source_time = frame->source_time;
    poses.player_count = count;
    poses.player_id = ids;
    poses.eye = eyes;
    poses.orientation = orientations;
    poses.velocity = velocities;
    poses.flags = flags;
    return cdir_match_publish_poses(publisher->match.handle, &poses) >= 0;
}

void publisher_note_movers(struct publisher* publisher, const struct server_frame* frame) {
    if (publisher->movers_life != frame->life) publisher->mover_count = 0;
    publisher->movers_life = frame->life;
    for (uint32_t i = 0; i < frame->mover_count; ++i) {
        uint32_t place = 0;
        while (place < publisher->mover_count && publisher->movers[place].model != frame->movers[i].model)
            ++place;
        if (place == CDIR_MAX_MOVERS) continue;
        publisher->movers[place] = frame->movers[i];
        if (place == publisher->mover_count) ++publisher->mover_count;
    }
}

/* By the number of their brush model. */
static bool announce_movers(struct publisher* publisher) {
    cdir_mover movers[CDIR_MAX_MOVERS];
    for (uint32_t i = 0; i < publisher->mover_count; ++i) {
        movers[i] = cdir_mover_default();
        movers[i].id = (uint32_t)publisher->movers[i].model;
        snprintf(movers[i].model, sizeof movers[i].model, "*%d", publisher->movers[i].model);
    }
    if (cdir_match_set_movers(publisher->match.handle, movers, publisher->mover_count) < 0) return false;
    publisher->announced_movers = publisher->mover_count;
    publisher->movers_epoch = publisher->match.epoch;
    return true;
}

static bool send_movers(struct publisher* publisher, const struct server_frame* frame) {
    if (publisher->mover_count == 0) return true;
    const bool announced = publisher->movers_epoch == publisher->match.epoch &&
                           publisher->announced_movers == publisher->mover_count;
    if (!announced && !announce_movers(publisher)) return false;
    uint32_t ids[CDIR_MAX_MOVERS];
    float positions[3 * CDIR_MAX_MOVERS], orientations[4 * CDIR_MAX_MOVERS];
    for (uint32_t i = 0; i < publisher->mover_count; ++i) {
        const struct mover_pose* mover = &publisher->movers[i];
        ids[i] = (uint32_t)mover->model;
        memcpy(positions + 3 * i, mover->origin, sizeof mover->origin);
        (void)cdir_orientation_from_angles(mover->angles, orientations + 4 * i);
    }
    cdir_mover_frame movers = cdir_mover_frame_default();
    movers.frame_time = frame->level_time * ns_per_ms;
    movers.source_time = frame->source_time;
    movers.mover_count = publisher->mover_count;
    movers.mover_id = ids;
    movers.position = positions;
    movers.orientation = orientations;
    return cdir_match_publish_movers(publisher->match.handle, &movers) >= 0;
}

static uint32_t player_id(uint8_t slot) {
    return slot == no_slot ? CDIR_NO_PLAYER : slot;
}

/* An event that cannot be sent is lost: the next ones matter more. */
static void send_event(struct publisher* publisher, int32_t level_time, const struct game_event* event) {
    cdir_match_event sent = cdir_match_event_default();
    sent.kind = event->kind;
    sent.frame_time = level_time * ns_per_ms;
    sent.actor = player_id(event->actor);
    sent.subject = player_id(event->subject);
    sent.value = event->value;
    snprintf(sent.detail, sizeof sent.detail, "%s", event->detail);
    if (cdir_match_publish_event(publisher->match.handle, &sent) >= 0) {
        ++publisher->events;
    } else {
        ++publisher->failures;
    }
}

bool publisher_send(struct publisher* publisher, const struct server_frame* frame) {
    if (!send_movers(publisher, frame) || !send_poses(publisher, frame)) {
        ++publisher->failures;
        return false;
    }
    ++publisher->frames;
    publisher_send_events(publisher, frame);
    return true;
}

void publisher_send_events(struct publisher* publisher, const struct server_frame* frame) {
    for (uint32_t i = 0; i < frame->event_count; ++i) {
        send_event(publisher, frame->level_time, &frame->events[i]);
    }
}
