/*
 * A game server: one player walks in a circle, and its pose is published once per server frame. With --door
 * a door slides across the circle's middle. announce_door() and play() are what a game has to do; the rest is
 * command line.
 */
#define _GNU_SOURCE

#include <getopt.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "connection.h"

static const double two_pi = 6.283185307179586;

struct walk {
    double centre[3];
    double radius; /* map units */
    double speed;  /* map units per second */
};

/* The eye's position, view quaternion (along the path) and velocity at `seconds`. */
static void walk_at(const struct walk* walk, double seconds, float eye[3], float orientation[4],
                    float velocity[3]) {
    const double angle = fmod(walk->speed * seconds / walk->radius, two_pi);
    const double heading = angle + two_pi / 4; /* along the circle, counter-clockwise from above */
    eye[0] = (float)(walk->centre[0] + walk->radius * cos(angle));
    eye[1] = (float)(walk->centre[1] + walk->radius * sin(angle));
    eye[2] = (float)walk->centre[2];
    orientation[0] = 0.0f; /* x y z w: a rotation about the z axis */
    orientation[1] = 0.0f;
    orientation[2] = (float)sin(heading / 2);
    orientation[3] = (float)cos(heading / 2);
    velocity[0] = (float)(walk->speed * cos(heading));
    velocity[1] = (float)(walk->speed * sin(heading));
    velocity[2] = 0.0f;
}

/* Slides up and down, a board of 8 by 2 * radius by 128 units. */
struct door {
    bool exists;
    double period; /* seconds from open to open */
};
static const uint32_t door_id = 1;
static const double door_height = 128;

/* A game whose map has brush models names one instead: strcpy(door.model, "*3"). */
static void announce_door(cdir_match match, const struct walk* walk) {
    const float half = (float)door_height / 2, width = (float)walk->radius;
    const float box[] = {1, 0, 0, 4,     -1, 0,  0, 4, /* normal, distance */
                         0, 1, 0, width, 0,  -1, 0, width, 0, 0, 1, half, 0, 0, -1, half};
    const uint32_t box_size = 6;
    cdir_mover door = cdir_mover_default();
    door.id = door_id;
    strcpy(door.kind, "func_door");
    door.half_spaces = box;
    door.hull_sizes = &box_size;
    door.hull_count = 1;
    check("announcing the door", cdir_match_set_movers(match, &door, 1));
}

static void publish_door(cdir_match match, const struct walk* walk, const struct door* door,
                         int64_t frame_time) {
    const double opened = (1 - cos(two_pi * (double)frame_time / 1e9 / door->period)) / 2;
    const float position[3] = {(float)walk->centre[0], (float)walk->centre[1],
                               (float)(walk->centre[2] + opened * door_height)};
    const float orientation[4] = {0, 0, 0, 1};
    cdir_mover_frame frame = cdir_mover_frame_default();
    frame.frame_time = frame_time;
    frame.mover_count = 1;
    frame.mover_id = &door_id;
    frame.position = position;
    frame.orientation = orientation;
    check("publishing the door", cdir_match_publish_movers(match, &frame));
}

/* Publishes frames for `seconds` (0 = without limit) or until the user stops the program. */
static void play(cdir_match match, const struct walk* walk, const struct door* door, double rate,
                 double seconds) {
    const int64_t start = monotonic_ns();
    const int64_t period = (int64_t)(1e9 / rate);
    uint32_t director_count = 0;
    for (int64_t number = 0; !stop_requested; ++number) {
        const int64_t frame_time = number * period; /* the game's own clock */
        if (seconds > 0 && (double)frame_time > seconds * 1e9) break;

        if (door->exists) publish_door(match, walk, door, frame_time); /* before the poses */
        const uint32_t player_id = 1;
        float eye[3];
        float orientation[4];
        float velocity[3];
        walk_at(walk, (double)frame_time / 1e9, eye, orientation, velocity);
        /* The player appears with the first frame. */
        const uint32_t flags = number == 0 ? CDIR_POSE_ALIVE | CDIR_POSE_DISCONTINUITY : CDIR_POSE_ALIVE;

        cdir_pose_frame frame = cdir_pose_frame_default();
        frame.frame_time = frame_time;
        frame.player_count = 1;
        frame.player_id = &player_id;
        frame.eye = eye;
        frame.orientation = orientation;
        frame.velocity = velocity;
        frame.flags = &flags;
        check("publishing poses", cdir_match_publish_poses(match, &frame));

        uint32_t count = 0;
        check("counting directors", cdir_match_director_count(match, &count));
        if (count != director_count) fprintf(stderr, "directors: %u\n", (unsigned)count);
        director_count = count;
        sleep_until(start + (number + 1) * period);
    }
}

static void print_usage(FILE* to) {
    fprintf(to,
            "Usage: example-game-server [options]\n"
            "Publishes the poses of one walking player (id 1).\n\n"
            "  --match ID            match id (default example)\n"
            "  --map NAME            the map's name in the director's configuration (default oa_dm1)\n"
            "  --centre X,Y,Z        of the circle, at eye height (default 0,0,64)\n"
            "  --radius R            of the circle, map units (default 128)\n"
            "  --door S              a door slides up and down across the circle, once in S seconds\n"
            "  --rate HZ             frames per second (default 60)\n"
            "  --seconds S           duration (default 0: until Ctrl-C)\n" CONNECTION_USAGE);
}

static void parse_centre(const char* text, double centre[3]) {
    char rest;
    if (sscanf(text, "%lf,%lf,%lf%c", &centre[0], &centre[1], &centre[2], &rest) != 3) {
        fprintf(stderr, "--centre: expected X,Y,Z, not '%s'\n", text);
        exit(EXIT_USAGE);
    }
}

/* A string that is too long keeps no zero byte, so that the library refuses it. */
static void copy_string(char* to, size_t size, const char* from) {
    const size_t length = strlen(from);
    memcpy(to, from, length < size ? length : size);
}

int main(int argc, char** argv) {
    static const struct option known[] = {{"match", required_argument, NULL, 0},
                                          {"map", required_argument, NULL, 0},
                                          {"centre", required_argument, NULL, 0},
                                          {"radius", required_argument, NULL, 0},
                                          {"rate", required_argument, NULL, 0},
                                          {"seconds", required_argument, NULL, 0},
                                          {"door", required_argument, NULL, 0},
                                          {"domain", required_argument, NULL, 0},
                                          {"interface", required_argument, NULL, 0},
                                          {"directors", required_argument, NULL, 0},
                                          {"security", required_argument, NULL, 0},
                                          {"help", no_argument, NULL, 'h'},
                                          {NULL, 0, NULL, 0}};

    cdir_context_options options = cdir_context_options_default();
    cdir_match_info info = cdir_match_info_default();
    struct walk walk = {{0, 0, 64}, 128, 200};
    struct door door = {false, 1};
    double seconds = 0;
    double rate = info.rate_hz;
    const char* match_id = "example";
    const char* map_name = "oa_dm1";
    int code;
    int index;
    while ((code = getopt_long(argc, argv, "", known, &index)) != -1) {
        if (code == 'h') {
            print_usage(stdout);
            return EXIT_SUCCESS;
        }
        if (code == '?') return EXIT_USAGE; /* getopt has printed the reason */
        const char* name = known[index].name;
        if (connection_option(&options, name, optarg)) continue;
        if (strcmp(name, "match") == 0) match_id = optarg;
        if (strcmp(name, "map") == 0) map_name = optarg;
        if (strcmp(name, "centre") == 0) parse_centre(optarg, walk.centre);
        if (strcmp(name, "radius") == 0) walk.radius = number_option(name, optarg, 1, 1e6);
        if (strcmp(name, "door") == 0) door = (struct door){true, number_option(name, optarg, 0.1, 1e6)};
        if (strcmp(name, "rate") == 0) rate = number_option(name, optarg, 1, 1000);
        if (strcmp(name, "seconds") == 0) seconds = number_option(name, optarg, 0, 1e9);
    }
    if (optind < argc) {
        fprintf(stderr, "unexpected argument '%s'\n", argv[optind]);
        return EXIT_USAGE;
    }

    catch_signals();
    copy_string(info.match_id, sizeof info.match_id, match_id);
    copy_string(info.map_name, sizeof info.map_name, map_name);
    info.rate_hz = (float)rate;
    cdir_player walker = cdir_player_default();
    walker.id = 1;
    strcpy(walker.name, "walker");
    cdir_context context;
    cdir_match match;
    check("joining the domain", cdir_context_open(&options, &context));
    check("opening the match", cdir_match_open(context, &info, &walker, 1, &match));
    if (door.exists) announce_door(match, &walk);
    play(match, &walk, &door, rate, seconds);
    check("closing", cdir_context_close(context)); /* closes the match too */
    return EXIT_SUCCESS;
}
