/*
 * What the game's thread hands the worker: plain values without pointers into the game. A player's id is the
 * number of the player's entity, 1 .. 32.
 */
#ifndef CAMERA_DIRECTOR_HALFLIFE_FRAME_H
#define CAMERA_DIRECTOR_HALFLIFE_FRAME_H

#include <camera_director/camera_director.h>
#include <stdint.h>

#include "game/match_state.h"
#include "game/message_ring.h"

enum { max_players = 32, max_events = 64 };

struct player_pose {
    uint32_t id, flags; /* CDIR_POSE_ values */
    float eye[3], velocity[3];
    float angles[3]; /* degrees; pitch (positive looks down), yaw, roll */
};

struct game_event {
    uint32_t kind; /* CDIR_EVENT_ value */
    uint32_t actor, subject;
    float value;
    char detail[32]; /* ASCII */
};

struct server_frame {
    int64_t frame_time;  /* ns since the map began */
    int64_t source_time; /* CLOCK_REALTIME when it was sampled, ns */
    uint32_t player_count, event_count;
    struct player_pose players[max_players];
    struct game_event events[max_events]; /* since the previous frame */
};

struct message {
    struct message_header header;
    union {
        struct match_state match;
        struct server_frame frame;
    };
};

#endif
