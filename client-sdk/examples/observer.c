/*
 * An observer: requests a shot and prints its camera once per display frame, as CSV. watch() is what a
 * spectator client has to do; the rest is command line.
 */
#define _GNU_SOURCE

#include <getopt.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "connection.h"

/* Prints the director's answer when it has changed since `last`, which becomes it. */
static void report_status(cdir_observer observer, cdir_shot_status* last) {
    cdir_shot_status status = cdir_shot_status_default();
    check("reading the status", cdir_observer_shot_status(observer, &status));
    if (status.state != last->state || strcmp(status.reason, last->reason) != 0) {
        fprintf(stderr, "shot: %s%s%s\n", cdir_shot_state_name(status.state), status.reason[0] ? ": " : "",
                status.reason);
    }
    *last = status;
}

/* The name of a player of the match; NULL when nobody in it has this number. */
static const char* name_of(uint32_t id, const cdir_player* players, uint32_t count) {
    for (uint32_t i = 0; i < count; ++i)
        if (players[i].id == id) return players[i].name;
    return NULL;
}

/* The reason of a cut, and of whom it speaks: "kill, player 3 and player 1". */
static void print_reason(const cdir_camera* camera, const cdir_player* players, uint32_t count) {
    const char* actor = name_of(camera->reason_actor, players, count);
    const char* subject = name_of(camera->reason_subject, players, count);
    if (camera->reason[0] != '\0') fprintf(stderr, ": %s", camera->reason);
    if (actor != NULL) fprintf(stderr, ", %s", actor);
    if (subject != NULL && camera->reason_subject != camera->reason_actor)
        fprintf(stderr, "%s %s", actor != NULL ? " and" : ",", subject);
    fputc('\n', stderr);
}

static bool same_reason(const cdir_camera* a, const cdir_camera* b) {
    return strcmp(a->reason, b->reason) == 0 && a->reason_actor == b->reason_actor &&
           a->reason_subject == b->reason_subject;
}

/* Says who is shown, and why, when that differs from the last camera of which it was said; NULL: there is
 * none. The target of a group shot is its first player. Returns false when it is not known yet. */
static bool report_target(cdir_observer observer, const cdir_camera* camera, const cdir_camera* last,
                          bool shows_group) {
    static cdir_player players[CDIR_MAX_PLAYERS];
    cdir_match_info info = cdir_match_info_default();
    uint32_t count = 0;
    if (last != NULL && camera->target == last->target && same_reason(camera, last)) return true;
    players[0] = cdir_player_default();
    const cdir_status status = cdir_observer_match_info(observer, &info, players, CDIR_MAX_PLAYERS, &count);
    check("reading the match", status);
    if (status == CDIR_NO_DATA) return false;
    const char* name = name_of(camera->target, players, count);
    if (camera->target == CDIR_CHOOSE_TARGET && (camera->flags & CDIR_CAMERA_TARGET_ABSENT) == 0)
        name = "none, a fixed camera";
    if (name != NULL) {
        fprintf(stderr, "target: %s%s", shows_group ? "the group of " : "", name);
        print_reason(camera, players, count);
    }
    return true;
}

static void print_camera(const cdir_camera* camera, const cdir_view* view) {
    printf("%" PRId64 ",%" PRIu32 ",%.4f,%.4f,%.4f,%.7f,%.7f,%.7f,%.7f,%.5f,%.2f,%" PRIu32 ",%" PRIu32 "\n",
           view->frame_time, camera->target, (double)camera->position[0], (double)camera->position[1],
           (double)camera->position[2], (double)camera->orientation[0], (double)camera->orientation[1],
           (double)camera->orientation[2], (double)camera->orientation[3], (double)camera->vertical_fov,
           (double)camera->clearance, camera->flags, view->segment);
}

static void end_without_camera(double seconds, const cdir_shot_status* status) {
    fprintf(stderr, "no camera after %.1f s: ", seconds);
    if (status->state == CDIR_SHOT_UNANSWERED)
        fprintf(stderr, "is a director at --directors, and does it know the match and its map?\n");
    else
        fprintf(stderr, "the director's last answer: %s%s%s\n", cdir_shot_state_name(status->state),
                status->reason[0] ? ": " : "", status->reason);
    if (status->state == CDIR_SHOT_WAITING_FOR_MAP || status->state == CDIR_SHOT_WAITING_FOR_PLAYER)
        fprintf(stderr, "a longer --seconds or --patience waits for more\n");
    exit(EXIT_FAILURE);
}

/* Prints the camera once per display frame, for `seconds` (0 = without limit) or until the user stops the
 * program. Ends with an error when there is none after `patience` seconds, or until the end. */
static void watch(cdir_observer observer, bool shows_group, double rate, double seconds, double patience) {
    const int64_t start = monotonic_ns();
    const int64_t period = (int64_t)(1e9 / rate);
    cdir_shot_status status = cdir_shot_status_default();
    status.state = CDIR_SHOT_NOT_REQUESTED;
    cdir_camera last = cdir_camera_default();
    bool seen = false, told = false;
    printf("frame_time,target,x,y,z,qx,qy,qz,qw,vertical_fov,clearance,flags,segment\n");
    for (int64_t number = 0; !stop_requested; ++number) {
        const double elapsed = (double)(number * period) / 1e9;
        if (seconds > 0 && elapsed > seconds) {
            if (!seen) end_without_camera(elapsed, &status);
            break;
        }

        check("receiving", cdir_observer_poll(observer, NULL));
        report_status(observer, &status);

        /* A spectator client would draw the scene with this camera now. */
        int64_t display_time;
        cdir_camera camera = cdir_camera_default();
        cdir_view view = cdir_view_default();
        if (cdir_observer_display_time(observer, &display_time) == CDIR_OK &&
            cdir_observer_camera_at(observer, display_time, &camera, &view) == CDIR_OK) {
            print_camera(&camera, &view);
            if (report_target(observer, &camera, told ? &last : NULL, shows_group)) {
                last = camera;
                told = true;
            }
            seen = true;
        }
        if (fflush(stdout) != 0) {
            perror("standard output");
            exit(EXIT_FAILURE);
        }
        if (!seen && elapsed > patience) end_without_camera(elapsed, &status);
        sleep_until(start + (number + 1) * period);
    }
}

static void report_counters(cdir_observer observer) {
    cdir_observer_counters counters = cdir_observer_counters_default();
    check("counting", cdir_observer_get_counters(observer, &counters));
    fprintf(stderr,
            "frames %" PRIu64 ", missing %" PRIu64 ", of an older epoch %" PRIu64 ", invalid %" PRIu64 "\n",
            counters.frames, counters.gaps, counters.stale_epoch, counters.invalid);
}

/* auto, a player's number, or those of a group separated by commas: of a group shot. Ends the program when
 * the value is none of these. `group` has room for CDIR_MAX_GROUP_SHOT, and has to live as long as the
 * request. */
static void target_option(const char* value, cdir_shot_request* request, uint32_t* group) {
    request->group_count = 0;
    request->target = CDIR_CHOOSE_TARGET;
    if (strcmp(value, "auto") == 0) return;
    for (const char* at = value;; ++at) {
        char* end = NULL;
        const unsigned long long number = strtoull(at, &end, 10);
        if (*at < '0' || *at > '9' || (*end != '\0' && *end != ',') || number >= CDIR_SHOW_GROUP ||
            request->group_count == CDIR_MAX_GROUP_SHOT) {
            fprintf(stderr,
                    "--target: expected auto, a player's number, or those of a group of at most %u such as "
                    "0,3, not '%s'\n",
                    CDIR_MAX_GROUP_SHOT, value);
            exit(EXIT_USAGE);
        }
        group[request->group_count++] = (uint32_t)number;
        at = end;
        if (*at == '\0') break;
    }
    if (request->group_count == 1) {
        request->target = group[0];
        request->group_count = 0;
    } else {
        request->target = CDIR_SHOW_GROUP;
        request->group = group;
    }
}

static void print_usage(FILE* to) {
    fprintf(
        to,
        "Usage: example-observer [options]\n"
        "Requests a shot and prints its camera once per display frame, as CSV.\n\n"
        "  --match ID            match id (default example)\n"
        "  --id ID               observer id, unique within the match (default example-observer)\n"
        "  --target N            a player's number, or auto (default auto), or the numbers of a group that\n"
        "                        one camera shows together, such as 0,3\n"
        "  --profile NAME        camera profile (default: the director's)\n"
        "  --overrides JSON      changes to the profile, such as {\"distance\": 90}\n"
        "  --rate HZ             display frames per second (default 60)\n"
        "  --seconds S           duration (default 0: until Ctrl-C)\n"
        "  --patience S          time limit for the first camera (default 30)\n" CONNECTION_USAGE);
}

int main(int argc, char** argv) {
    static const struct option known[] = {
        {"match", required_argument, NULL, 0},     {"id", required_argument, NULL, 0},
        {"target", required_argument, NULL, 0},    {"profile", required_argument, NULL, 0},
        {"overrides", required_argument, NULL, 0}, {"rate", required_argument, NULL, 0},
        {"seconds", required_argument, NULL, 0},   {"patience", required_argument, NULL, 0},
        {"domain", required_argument, NULL, 0},    {"interface", required_argument, NULL, 0},
        {"directors", required_argument, NULL, 0}, {"security", required_argument, NULL, 0},
        {"help", no_argument, NULL, 'h'},          {NULL, 0, NULL, 0}};

    cdir_context_options options = cdir_context_options_default();
    cdir_shot_request request = cdir_shot_request_default();
    uint32_t group[CDIR_MAX_GROUP_SHOT];
    double rate = 60;
    double seconds = 0;
    double patience = 30;
    const char* match_id = "example";
    const char* observer_id = "example-observer";
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
        if (strcmp(name, "id") == 0) observer_id = optarg;
        if (strcmp(name, "profile") == 0) request.profile = optarg;
        if (strcmp(name, "overrides") == 0) request.overrides = optarg;
        if (strcmp(name, "rate") == 0) rate = number_option(name, optarg, 1, 1000);
        if (strcmp(name, "seconds") == 0) seconds = number_option(name, optarg, 0, 1e9);
        if (strcmp(name, "patience") == 0) patience = number_option(name, optarg, 0, 1e9);
        if (strcmp(name, "target") == 0) target_option(optarg, &request, group);
    }
    if (optind < argc) {
        fprintf(stderr, "unexpected argument '%s'\n", argv[optind]);
        return EXIT_USAGE;
    }

    catch_signals();
    cdir_context context;
    cdir_observer observer;
    check("joining the domain", cdir_context_open(&options, &context));
    check("opening the observer", cdir_observer_open(context, match_id, observer_id, NULL, &observer));
    check("requesting the shot", cdir_observer_request(observer, &request));
    watch(observer, request.target == CDIR_SHOW_GROUP, rate, seconds, patience);
    report_counters(observer);
    check("closing", cdir_context_close(context)); /* closes the observer and withdraws the request too */
    return EXIT_SUCCESS;
}
