/* What the observers inside a game's processes write, one struct after the other: the witness between server
 * and game module (witness.c) and the preloaded library of a client (drawn_views.c). Both clocks are
 * CLOCK_MONOTONIC in nanoseconds. */
#ifndef CAMDIR_TEST_GAME_RECORDS_H
#define CAMDIR_TEST_GAME_RECORDS_H

#include <stdint.h>

enum { witness_slots = 16, witness_corpses = 8, drawn_entities = 96 };

/* One client slot as the engine is about to send it. */
struct witness_player {
    int32_t connected; /* its configstring is not empty */
    int32_t team;      /* of the configstring: 0 free, 1 red, 2 blue, 3 spectator */
    int32_t bot;
    int32_t in_game; /* spawned at least once */
    /* playerState: what a client sees that has this slot */
    int32_t pm_type, pm_flags, view_flags, client_num, view_height, health;
    float origin[3], angles[3]; /* degrees: pitch yaw roll */
    /* entityState: what other clients see of it */
    int32_t entity_flags, powerups; /* a bit for each power-up */
    float base[3], velocity[3];     /* clients go on at the velocity while the next snapshot is late */
};

/* What a dead player leaves behind at their respawn; drawn with the player's model. */
struct witness_corpse {
    int32_t slot;
    float base[3];
};

enum { witness_starts = 1, witness_ran_frame = 2, witness_ends = 3 };

struct witness_record {
    int32_t kind;
    int32_t level_time; /* ms */
    int32_t sent; /* snapshots were sent after this frame: 0 when the server caught up with two at once */
    int32_t reserved;
    int64_t time; /* when the frame ended */
    /* Inside the module's frame call, and inside its other calls since the previous frame; then the same and
     * what the witness itself took. */
    int64_t frame_ns, between_ns, whole_frame_ns, whole_between_ns;
    struct witness_player players[witness_slots];
    int32_t corpse_count, reserved2;
    struct witness_corpse corpses[witness_corpses];
};

/* One picture of a client. */
struct drawn_record {
    int64_t time;        /* when it was complete */
    int64_t packet_time; /* when the client had read its newest packet */
    uint32_t packet;     /* sequence number of that packet */
    int32_t width, height;
    /* Pixels in the marker's colour; the rectangle is inclusive, y downwards from the top row. */
    int32_t marker_pixels, marker_left, marker_top, marker_right, marker_bottom;
    float view[16]; /* column-major; map to eye: x right, y up, z backwards */
    float projection[16];
    int32_t entity_count;
    float entities[drawn_entities][3]; /* origins of the models drawn, in eye coordinates */
};

#endif
