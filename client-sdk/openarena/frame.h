/* SPDX-License-Identifier: GPL-2.0-or-later */
/*
 * What the parts of the module hand each other: one server frame sampled on the game's thread, and the
 * directors' answers. Plain values without pointers into the game. A slot is a client's number, 0 .. 63, and
 * also the player's id towards the director. Lengths are map units, axes those of Quake.
 */
#ifndef CAMERA_DIRECTOR_OPENARENA_FRAME_H
#define CAMERA_DIRECTOR_OPENARENA_FRAME_H

#include <camera_director/camera_director.h>
#include <stdint.h>

enum {
    max_slots = 64,
    no_slot = 255, /* in a uint8_t that holds a slot: none */
    max_events = 64,
    max_movers = 128,
    history_length = 64
};

enum { team_free = 0, team_red = 1, team_blue = 2, team_spectator = 3 };

struct player_pose {
    uint8_t in_game; /* the slot is in use and its client has entered the game; all else is 0 otherwise */
    uint8_t bot;
    uint8_t spectator;    /* has no body: spectates, follows, waits for a round, or is in the intermission */
    uint8_t alive;        /* never with spectator */
    uint8_t teleport_bit; /* toggles at every respawn and teleport */
    uint8_t team;         /* team_ value */
    uint8_t weapon;       /* in hand, the game's number */
    int16_t viewheight;   /* of the eye above origin */
    int16_t health;
    float origin[3], velocity[3];
    float angles[3]; /* pitch (positive looks down), yaw, roll in degrees, any multiple of a turn added */
};

enum { viewer_auto = 0 /* the director chooses the player */, viewer_follow = 1 };

/* What the spectator in a slot wants of the director. */
struct viewer_request {
    uint8_t active;
    uint8_t mode;     /* viewer_ value */
    uint8_t target;   /* slot, with viewer_follow */
    char profile[32]; /* "" = the director's default */
};

struct game_event {
    uint8_t kind;           /* CDIR_EVENT_ value */
    uint8_t actor, subject; /* slot or no_slot */
    float value;
    const char* detail; /* static text of at most 31 bytes, never null */
};

struct mover_pose {
    int16_t model; /* number of the map's inline brush model, "*N" */
    float origin[3], angles[3];
};

struct server_frame {
    uint32_t life;       /* counts the game's initialisations in this process, from 1 */
    int32_t level_time;  /* ms */
    int64_t source_time; /* CLOCK_REALTIME when it was sampled, ns */
    struct player_pose players[max_slots];
    struct viewer_request viewers[max_slots];
    uint32_t event_count, mover_count;
    struct game_event events[max_events];
    struct mover_pose movers[max_movers]; /* those that moved since the previous frame */
};

/* The newest frames of this life, on the game's thread. */
struct frame_history {
    uint64_t count; /* frames sampled in this life */
    struct server_frame frames[history_length];
};

/* The frame `age` frames before the newest, or null when it is not kept. */
static inline const struct server_frame* frame_before(const struct frame_history* history, uint64_t age) {
    if (age >= history->count || age >= history_length) return NULL;
    return &history->frames[(history->count - 1 - age) % history_length];
}

struct viewer_camera {
    uint8_t live;       /* a camera of this life has arrived; the fields below are unset otherwise */
    uint8_t target;     /* slot or no_slot */
    uint32_t segment;   /* changes at every cut */
    int32_t level_time; /* of the poses that it was computed for */
    uint32_t flags;     /* CDIR_CAMERA_ values */
    float position[3];
    float orientation[4]; /* x y z w, of length 1 */
    float vertical_fov;   /* radians */
    float clearance;      /* lower bound of the distance to the nearest obstacle */
};

/* The director's answer to a slot's request. */
struct viewer_shot {
    uint32_t state; /* CDIR_SHOT_ value */
    char reason[124];
};

/* What the worker knows, all slots at once. Finite numbers, terminated strings. */
struct director_report {
    uint32_t life;      /* the cameras and shots are of this life */
    uint32_t directors; /* that receive the match's poses now */
    uint64_t epoch;     /* of the match; 0 = not published */
    uint64_t published_frames, published_events, failures;
    uint64_t skipped_frames;   /* not published: the worker was late, or could not reach the network */
    int64_t recorded_rows;     /* of the recording in progress; -1 = none */
    char error[160];           /* why nothing is published; "" = all is well */
    char recording_error[160]; /* why nothing is recorded */
    struct viewer_camera cameras[max_slots];
    struct viewer_shot shots[max_slots];
};

#endif
