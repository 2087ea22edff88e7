/* SPDX-License-Identifier: GPL-2.0-or-later */
#include "shots.h"

#include <stdio.h>
#include <string.h>

static const int64_t ns_per_ms = 1000000;
static const int64_t retry_ns = 1000000000; /* after a failure */

static void close_shot(struct shot* shot) {
    if (shot->open) (void)cdir_observer_close(shot->observer);
    memset(shot, 0, sizeof *shot);
}

static bool same_request(const struct viewer_request* a, const struct viewer_request* b) {
    return a->active == b->active && a->mode == b->mode &&
           (a->mode != viewer_follow || a->target == b->target) && strcmp(a->profile, b->profile) == 0;
}

static bool open_shot(struct shot* shot, cdir_context context, const char* match_id, uint32_t slot) {
    char observer_id[32];
    if (shot->open) return true;
    snprintf(observer_id, sizeof observer_id, "spectator-%u", slot);
    shot->open = cdir_observer_open(context, match_id, observer_id, NULL, &shot->observer) >= 0;
    return shot->open;
}

static bool request_shot(struct shot* shot, const struct viewer_request* viewer) {
    cdir_shot_request request = cdir_shot_request_default();
    if (viewer->mode == viewer_follow) request.target = viewer->target;
    request.profile = viewer->profile;
    if (cdir_observer_request(shot->observer, &request) < 0) return false;
    shot->request = *viewer;
    return true;
}

void shots_request(struct shots* shots, cdir_context context, const char* match_id,
                   const struct viewer_request viewers[max_slots], int64_t now) {
    if (context.id != shots->context.id) memset(shots, 0, sizeof *shots); /* its observers are closed */
    shots->context = context;
    for (uint32_t slot = 0; slot < max_slots; ++slot) {
        struct shot* shot = &shots->slots[slot];
        const struct viewer_request* viewer = &viewers[slot];
        if (!viewer->active) {
            close_shot(shot);
        } else if (!(shot->open && same_request(&shot->request, viewer)) && now >= shot->retry_time) {
            const bool good = open_shot(shot, context, match_id, slot) && request_shot(shot, viewer);
            snprintf(shot->error, sizeof shot->error, "%s", good ? "" : cdir_last_error());
            shot->retry_time = good ? 0 : now + retry_ns;
        }
    }
}

static void fill_camera(struct viewer_camera* camera, const cdir_camera* from, const cdir_view* view) {
    camera->live = 1;
    camera->target = from->target < max_slots ? (uint8_t)from->target : no_slot;
    camera->segment = view->segment;
    camera->level_time = (int32_t)(view->frame_time / ns_per_ms);
    camera->flags = from->flags;
    memcpy(camera->position, from->position, sizeof camera->position);
    memcpy(camera->orientation, from->orientation, sizeof camera->orientation);
    camera->vertical_fov = from->vertical_fov;
    camera->clearance = from->clearance;
}

/* The observer's last camera outlives its epoch until the next one's arrives: the answer's epoch tells. */
static void poll_shot(struct shot* shot, uint64_t epoch, struct viewer_camera* camera,
                      struct viewer_shot* answer) {
    cdir_shot_status status = cdir_shot_status_default();
    cdir_camera newest = cdir_camera_default();
    cdir_view view = cdir_view_default();
    memset(camera, 0, sizeof *camera); /* with the padding: compared as bytes */
    memset(answer, 0, sizeof *answer);
    answer->state = CDIR_SHOT_NOT_REQUESTED;
    snprintf(answer->reason, sizeof answer->reason, "%s", shot->error);
    if (!shot->open || cdir_observer_poll(shot->observer, NULL) < 0 ||
        cdir_observer_shot_status(shot->observer, &status) < 0) {
        return;
    }
    answer->state = status.state;
    if (shot->error[0] == '\0') {
        snprintf(answer->reason, sizeof answer->reason, "%.*s", (int)sizeof answer->reason - 1,
                 status.reason);
    }
    if (status.state != CDIR_SHOT_ACCEPTED || status.epoch != epoch) return;
    if (cdir_observer_newest_camera(shot->observer, &newest, &view) != CDIR_OK) return;
    if (view.frame_time < 0 || view.frame_time / ns_per_ms > INT32_MAX) return; /* no time of this server */
    fill_camera(camera, &newest, &view);
}

static bool contains(uint64_t slots, uint32_t slot) {
    return (slots >> slot & 1) != 0;
}

bool shots_poll(struct shots* shots, uint64_t slots, uint64_t epoch, struct director_report* report) {
    bool changed = false;
    for (uint32_t slot = 0; slot < max_slots; ++slot) {
        struct viewer_camera camera;
        struct viewer_shot answer;
        if (!contains(slots, slot)) continue;
        poll_shot(&shots->slots[slot], epoch, &camera, &answer);
        if (memcmp(&camera, &report->cameras[slot], sizeof camera) == 0 &&
            memcmp(&answer, &report->shots[slot], sizeof answer) == 0) {
            continue;
        }
        memcpy(&report->cameras[slot], &camera, sizeof camera);
        memcpy(&report->shots[slot], &answer, sizeof answer);
        changed = true;
    }
    return changed;
}

uint64_t shots_behind(const struct shots* shots, const struct director_report* report, int32_t level_time) {
    uint64_t slots = 0;
    for (uint32_t slot = 0; slot < max_slots; ++slot) {
        const struct viewer_camera* camera = &report->cameras[slot];
        if (shots->slots[slot].open && report->shots[slot].state == CDIR_SHOT_ACCEPTED &&
            (!camera->live || camera->level_time < level_time)) {
            slots |= UINT64_C(1) << slot;
        }
    }
    return slots;
}

cdir_status shots_wait(const struct shots* shots, uint64_t slots, int64_t timeout) {
    /* The last one: it is served after the others. */
    const uint32_t slot = 63 - (uint32_t)__builtin_clzll(slots);
    return cdir_observer_wait(shots->slots[slot].observer, timeout);
}
