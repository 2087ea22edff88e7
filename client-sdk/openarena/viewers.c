/* SPDX-License-Identifier: GPL-2.0-or-later */
#include "viewers.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "engine.h"
#include "game.h"
#include "overlay.h"
#include "proxy.h"
#include "refusal_notice.h"
#include "roster.h"
#include "shown_name.h"
#include "view_prediction.h"

/* A camera of older poses is not shown, ms. */
static const int32_t max_camera_age = 250;
/* When the game has not followed a player as asked, it is asked again after this time, ms. */
static const int32_t follow_interval = 1000;
/* Of the game's own view before a camera, ms: a client that does not receive every frame must see each of two
 * cuts in a row, because together they leave the teleport bit as it was. */
static const int32_t min_own_view = 100;

/* Where a spectator flies freely. */
struct place {
    float origin[3], angles[3];
};

struct viewer {
    struct choice choice;
    char profile[32];
    struct shown_name name;

    /* Of the present time as a spectator. */
    uint8_t asked; /* the player that the game was asked to follow last */
    int32_t ask_time;
    bool away;      /* has left its place for a camera or a player */
    bool has_place; /* has flown freely before that */
    struct place place;
    int32_t level_time;   /* of the newest frame */
    bool viewed;          /* some frame before it */
    int32_t own_time;     /* level time at which the game's own view began */
    bool requested;       /* a shot, in that frame */
    int32_t request_time; /* level time of the first frame since that did */
    struct camera_motion motion;
    struct overlay overlay;
    struct refusal_notice refusal;
};

static struct viewer viewers[max_slots];
static struct view_counters counters;
static int call_depth;
static bool overlays_on;
/* Sets of slots, as bits: most slots are empty, and looking at each costs more than everything else here. */
static uint64_t human_slots;   /* clients that are no bots */
static uint64_t viewer_slots;  /* of them, those that spectate */
static uint64_t overlay_slots; /* of them, those who are shown a camera */

const struct view_counters* viewers_counters(void) {
    return &counters;
}

/* ------------------------------------------------------------------------- inside and outside the game */

static bool contains(uint64_t slots, int slot) {
    return (slots >> slot & 1) != 0;
}

static void put(uint64_t* slots, int slot, bool member) {
    const uint64_t bit = UINT64_C(1) << slot;
    *slots = member ? *slots | bit : *slots & ~bit;
}

/* Removes the lowest slot from a set that is not empty. */
static int take_slot(uint64_t* slots) {
    const int slot = __builtin_ctzll(*slots);
    *slots &= *slots - 1;
    return slot;
}

void viewers_suspend(void) {
    if (call_depth++ > 0 || !overlays_on) return;
    overlays_on = false;
    for (uint64_t slots = overlay_slots; slots != 0;) {
        const int slot = take_slot(&slots);
        uint8_t* const state = engine_player_state(slot);
        if (state != NULL) overlay_take_off(&viewers[slot].overlay, state);
    }
}

void viewers_resume(bool snapshots_follow) {
    if (--call_depth > 0 || !snapshots_follow) return;
    overlays_on = true;
    for (uint64_t slots = overlay_slots; slots != 0;) {
        const int slot = take_slot(&slots);
        uint8_t* const state = engine_player_state(slot);
        if (state != NULL) overlay_put_on(&viewers[slot].overlay, state);
    }
}

/* -------------------------------------------------------------------------------------- life and death */

static void forget_view(int slot) {
    struct viewer* const viewer = &viewers[slot];
    put(&viewer_slots, slot, false);
    put(&overlay_slots, slot, false);
    viewer->asked = no_slot;
    viewer->away = viewer->has_place = viewer->requested = viewer->viewed = false;
    memset(&viewer->motion, 0, sizeof viewer->motion);
    memset(&viewer->overlay, 0, sizeof viewer->overlay);
    memset(&viewer->refusal, 0, sizeof viewer->refusal);
}

static void forget_viewer(int slot) {
    struct viewer* const viewer = &viewers[slot];
    memset(viewer, 0, sizeof *viewer);
    viewer->choice = choice_of_newcomer();
    viewer->name = shown_name_own();
    forget_view(slot);
    put(&human_slots, slot, false);
}

void viewers_reset(void) {
    for (int slot = 0; slot < max_slots; ++slot) {
        struct viewer* const viewer = &viewers[slot];
        const uint8_t name = viewer->name.slot;
        viewer->name = shown_name_own();
        /* A restart on the same map does not send the names again. */
        if (contains(human_slots, slot) && name != no_slot) viewer->name.slot = name_unsure;
        forget_view(slot);
    }
    human_slots = 0; /* until the game has them connect again */
    call_depth = 1;  /* a game that ended by an error never returned from its calls */
}

void viewers_connect(int slot, bool first_time, bool bot) {
    if (first_time || bot) forget_viewer(slot);
    put(&human_slots, slot, !bot);
}

void viewers_disconnect(int slot) {
    forget_viewer(slot);
}

static bool plays(uint8_t slot) {
    return slot < max_slots && roster_at(slot)->in_use && roster_at(slot)->team != team_spectator;
}

static void stop_viewing(struct viewer* viewer, int slot) {
    if (!contains(viewer_slots, slot)) return;
    forget_view(slot);
    viewer->name = shown_name_own(); /* with the team, the game has sent the name */
    if (viewer->choice.what == choice_follow) choice_set(&viewer->choice, choice_auto);
}

/* The game announces a team before it spawns the client as its player. */
static void leave_spectators(int slot) {
    uint8_t* const state = engine_player_state(slot);
    if (state != NULL) overlay_prepare_spawn(&viewers[slot].overlay, state);
    stop_viewing(&viewers[slot], slot);
}

void viewers_take_configstring(int number) {
    const int player = number - CONFIGSTRING_PLAYERS;
    if (player < 0 || player >= max_slots) return;
    const bool leaves = !plays((uint8_t)player);
    for (uint64_t slots = human_slots; slots != 0;) {
        const int slot = take_slot(&slots);
        if (leaves) choice_take_departure(&viewers[slot].choice, (uint8_t)player);
        if (contains(viewer_slots, slot))
            shown_name_take_configstring(&viewers[slot].name, slot, (uint8_t)player);
    }
    if (contains(viewer_slots, player) && !leaves) leave_spectators(player);
}

/* --------------------------------------------------------------------------------- the viewer's choice */

bool viewers_choose(int slot, enum viewer_choice choice) {
    if (!contains(human_slots, slot)) return false;
    choice_set(&viewers[slot].choice, choice);
    return true;
}

void viewers_take_follow(int slot, enum follow_command command, uint8_t named) {
    if (!contains(human_slots, slot) || (command == follow_stop && plays((uint8_t)slot))) return;
    choice_take_command(&viewers[slot].choice, command, named);
}

bool viewers_choose_profile(int slot, const char* profile) {
    if (!contains(human_slots, slot)) return false;
    snprintf(viewers[slot].profile, sizeof viewers[slot].profile, "%s", profile);
    return true;
}

static const char* profile_of(const struct viewer* viewer) {
    return viewer->profile[0] != '\0' ? viewer->profile : module_settings()->profile;
}

static bool wants_director(const struct viewer* viewer) {
    return viewer->choice.what != choice_off && module_settings()->spectate;
}

static bool requests_shot(const struct viewer* viewer) {
    return wants_director(viewer) && (viewer->choice.what == choice_auto || plays(viewer->choice.player));
}

static bool is_intermission(const uint8_t* state) {
    return read_int(state, PS_PM_TYPE) == PM_INTERMISSION;
}

static uint8_t followed_by_game(int slot, const uint8_t* state) {
    const int32_t number = read_int(state, PS_CLIENT_NUMBER);
    const bool follows = (read_int(state, PS_PM_FLAGS) & PM_FLAG_FOLLOW) != 0;
    return follows && number != slot && number >= 0 && number < max_slots ? (uint8_t)number : no_slot;
}

static uint8_t followed_by(uint8_t slot) {
    return followed_by_game(slot, engine_player_state(slot));
}

static void take_in_spectator(struct viewer* viewer, int slot, const uint8_t* state) {
    const bool begins = !contains(viewer_slots, slot);
    put(&viewer_slots, slot, true);
    if (is_intermission(state)) {
        choice_skip_frame(&viewer->choice);
    } else if (begins) {
        choice_begin(&viewer->choice, followed_by_game(slot, state), followed_by);
    } else {
        choice_take_frame(&viewer->choice, followed_by_game(slot, state), followed_by);
    }
}

static bool has_entered(int slot, const uint8_t* state) {
    return state != NULL && roster_at(slot)->in_use &&
           read_element(state, PS_PERSISTANT, PERSISTANT_SPAWN_COUNT) > 0;
}

static void fill_request(struct viewer_request* request, const struct viewer* viewer) {
    const bool follows = viewer->choice.what == choice_follow;
    request->active = 1;
    request->mode = follows ? viewer_follow : viewer_auto;
    request->target = follows ? viewer->choice.player : no_slot;
    memcpy(request->profile, profile_of(viewer), sizeof request->profile);
}

void viewers_fill_requests(struct viewer_request requests[max_slots]) {
    for (uint64_t slots = human_slots; slots != 0;) {
        const int slot = take_slot(&slots);
        struct viewer* const viewer = &viewers[slot];
        const uint8_t* const state = engine_player_state(slot);
        if (!has_entered(slot, state)) {
            stop_viewing(viewer, slot);
        } else if (roster_at(slot)->team != team_spectator) {
            stop_viewing(viewer, slot);
            choice_skip_frame(&viewer->choice);
        } else {
            take_in_spectator(viewer, slot, state);
            if (requests_shot(viewer)) fill_request(&requests[slot], viewer);
        }
    }
}

/* --------------------------------------------------------------------------------- the game's own view */

static void ask_to_follow(struct viewer* viewer, int slot, uint8_t target) {
    const bool asked = viewer->asked == target && viewer->level_time - viewer->ask_time < follow_interval;
    if (viewer->choice.followed == target || asked || target == slot || !plays(target)) return;
    char number[4];
    snprintf(number, sizeof number, "%d", target);
    const char* const words[] = {"follow", number};
    game_client_command(slot, words, 2);
    choice_expect(&viewer->choice, target);
    viewer->asked = target;
    viewer->ask_time = viewer->level_time;
}

static void put_back(const struct viewer* viewer, int slot, uint8_t* state) {
    static const float still[3] = {0, 0, 0};
    int32_t user[3];
    if (!viewer->has_place) return;
    engine_user_angles(slot, user);
    write_vector(state, PS_ORIGIN, viewer->place.origin);
    write_vector(state, PS_VELOCITY, still);
    write_vector(state, PS_VIEW_ANGLES, viewer->place.angles);
    for (size_t i = 0; i < 3; ++i) {
        const int32_t angle = (int32_t)lrint(remainder(viewer->place.angles[i], 360.0) * 65536.0 / 360.0);
        const uint32_t delta = ((uint32_t)angle - (uint32_t)user[i]) & 65535u;
        write_int(state, PS_DELTA_ANGLES + 4 * i, (int32_t)delta);
    }
}

/* Keeps the place of a spectator who flies freely, and gives it back after the director's camera: without it,
 * the game would leave them wherever the player was whom it followed last. */
static void keep_place(struct viewer* viewer, int slot, uint8_t* state, bool camera) {
    uint8_t followed = viewer->choice.followed;
    const bool by_module = followed != no_slot && followed != viewer->choice.player;
    if (!wants_director(viewer) && viewer->away && by_module) {
        const char* const words[] = {"follow"};
        game_client_command(slot, words, 1);
        viewer->asked = no_slot;
        followed = followed_by_game(slot, state);
        choice_expect(&viewer->choice, followed);
    }
    if (camera || (wants_director(viewer) && followed != no_slot)) {
        viewer->away = true;
        return;
    }
    if (followed == no_slot && !is_intermission(state)) {
        if (viewer->away) put_back(viewer, slot, state);
        read_vector(viewer->place.origin, state, PS_ORIGIN);
        read_vector(viewer->place.angles, state, PS_VIEW_ANGLES);
        viewer->has_place = true;
    }
    viewer->away = false;
}

/* ------------------------------------------------------------------------------- the director's camera */

static const struct player_pose* pose_at(const struct frame_history* history, int32_t level_time,
                                         uint8_t slot) {
    const struct server_frame* frame = slot < max_slots ? frame_before(history, 0) : NULL;
    for (uint64_t age = 1; frame != NULL && frame->level_time > level_time; ++age) {
        frame = frame_before(history, age);
    }
    return frame != NULL && frame->level_time == level_time ? &frame->players[slot] : NULL;
}

static struct view current_view(const struct viewer* viewer, const struct frame_history* history) {
    const struct viewer_camera* const camera = &viewer->motion.newest;
    return predict_view(&viewer->motion, viewer->level_time,
                        pose_at(history, camera->level_time, camera->target),
                        pose_at(history, viewer->level_time, camera->target));
}

/* Cameras of poses before the request belong to an earlier one, or to the slot's previous client; those of
 * poses that are yet to come would keep out the right ones. */
static bool take_camera(struct viewer* viewer, const struct viewer_camera* camera) {
    const bool requests = requests_shot(viewer);
    if (requests && !viewer->requested) viewer->request_time = viewer->level_time;
    if (!requests) viewer->motion.count = 0;
    viewer->requested = requests;
    return requests && camera != NULL && camera->live && camera->level_time >= viewer->request_time &&
           camera->level_time <= viewer->level_time && camera_motion_take(&viewer->motion, camera);
}

static bool has_camera(const struct viewer* viewer) {
    const int64_t age = (int64_t)viewer->level_time - viewer->motion.newest.level_time;
    return viewer->motion.count > 0 && age >= 0 && age <= max_camera_age;
}

static void show_camera(struct viewer* viewer, int slot, const struct frame_history* history,
                        bool new_segment) {
    const struct view view = current_view(viewer, history);
    const uint8_t target = viewer->motion.newest.target;
    if (new_segment || !viewer->overlay.active) ++counters.cuts;
    ++counters.camera_frames;
    overlay_show_camera(&viewer->overlay, slot, viewer->level_time, &view, new_segment);
    if (viewer->choice.what == choice_auto) ask_to_follow(viewer, slot, target);
    shown_name_set(&viewer->name, slot, plays(target) ? target : no_slot, viewer->level_time);
}

static void show_own(struct viewer* viewer, int slot, uint8_t* state) {
    const bool fell_back = viewer->overlay.active && requests_shot(viewer) && !is_intermission(state);
    if (fell_back) ++counters.fallbacks;
    if (viewer->overlay.active || !viewer->viewed) viewer->own_time = viewer->level_time;
    viewer->viewed = true;
    overlay_show_own(&viewer->overlay, slot, state);
    shown_name_set(&viewer->name, slot, no_slot, viewer->level_time);
}

static bool may_show_camera(const struct viewer* viewer, const uint8_t* state) {
    const bool own_was_seen =
        viewer->viewed && (int64_t)viewer->level_time - viewer->own_time >= min_own_view;
    return has_camera(viewer) && !is_intermission(state) && (viewer->overlay.active || own_was_seen);
}

static void update_view(int slot, const struct director_report* report, const struct frame_history* history) {
    struct viewer* const viewer = &viewers[slot];
    uint8_t* const state = engine_player_state(slot);
    viewer->level_time = frame_before(history, 0)->level_time;
    const bool new_segment = take_camera(viewer, report != NULL ? &report->cameras[slot] : NULL);
    const bool shows_camera = may_show_camera(viewer, state);
    refusal_notice_update(&viewer->refusal, slot,
                          report != NULL && viewer->requested ? &report->shots[slot] : NULL,
                          viewer->level_time);
    if (viewer->choice.what == choice_follow && wants_director(viewer) && !is_intermission(state))
        ask_to_follow(viewer, slot, viewer->choice.player);
    keep_place(viewer, slot, state, shows_camera);
    if (shows_camera) {
        show_camera(viewer, slot, history, new_segment);
    } else {
        show_own(viewer, slot, state);
    }
    put(&overlay_slots, slot, viewer->overlay.active);
}

void viewers_apply(const struct director_report* report, const struct frame_history* history) {
    const struct server_frame* const now = frame_before(history, 0);
    if (now == NULL) return;
    const bool current = report != NULL && report->life == now->life;
    for (uint64_t slots = viewer_slots; slots != 0;) {
        const int slot = take_slot(&slots);
        update_view(slot, current ? report : NULL, history);
    }
}

bool viewers_status(int slot, struct viewer_status* status) {
    const struct viewer* const viewer = &viewers[slot];
    if (!contains(viewer_slots, slot)) return false;
    status->choice = viewer->choice.what;
    snprintf(status->profile, sizeof status->profile, "%s", profile_of(viewer));
    status->requests = requests_shot(viewer);
    status->camera = viewer->overlay.active;
    status->target = status->camera ? viewer->motion.newest.target : viewer->choice.followed;
    status->camera_age = status->camera ? viewer->level_time - viewer->motion.newest.level_time : 0;
    return true;
}
