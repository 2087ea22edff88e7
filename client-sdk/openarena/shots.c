/* SPDX-License-Identifier: GPL-2.0-or-later */
#include "shots.h"

#include <stdio.h>
#include <string.h>

static const int64_t ns_per_ms = 1000000;

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
    snprintf(observer_id, sizeof observer_id, "spectator-%u", slot);
    shot->open = cdir_observer_open(context, match_id, observer_id, NULL, &shot->observer) >= 0;
    return shot->open;
}

void shots_request(struct shots* shots, cdir_context context, const char* match_id,
                   const struct viewer_request viewers[max_slots]) {
    for (uint32_t slot = 0; slot < max_slots; ++slot) {
        struct shot* shot = &shots->slots[slot];
        const struct viewer_request* viewer = &viewers[slot];
        if (!viewer->active) {
            close_shot(shot);
            continue;
        }
        if (shot->open && same_request(&shot->request, viewer)) continue;
        if (!shot->open && !open_shot(shot, context, match_id, slot)) continue;
        cdir_shot_request request = cdir_shot_request_default();
        if (viewer->mode == viewer_follow) request.target = viewer->target;
        request.profile = viewer->profile;
        if (cdir_observer_request(shot->observer, &request) >= 0) shot->request = *viewer;
    }
}

static struct viewer_camera camera_of(const cdir_view* view) {
    struct viewer_camera camera;
    memset(&camera, 0, sizeof camera);
    camera.live = 1;
    camera.target = view->camera.target < max_slots ? (uint8_t)view->camera.target : no_slot;
    camera.segment = view->segment;
    camera.level_time = (int32_t)(view->frame_time / ns_per_ms);
    camera.flags = view->camera.flags;
    memcpy(camera.position, view->camera.position, sizeof camera.position);
    memcpy(camera.orientation, view->camera.orientation, sizeof camera.orientation);
    camera.vertical_fov = view->camera.vertical_fov;
    camera.clearance = view->camera.clearance;
    return camera;
}

/* The observer's last camera outlives its epoch until the next one's arrives: the answer's epoch tells. */
static void poll_shot(struct shot* shot, uint64_t epoch, struct viewer_camera* camera,
                      struct viewer_shot* answer) {
    cdir_shot_status status = cdir_shot_status_default();
    cdir_view view = cdir_view_default();
    memset(camera, 0, sizeof *camera);
    memset(answer, 0, sizeof *answer);
    answer->state = CDIR_SHOT_NOT_REQUESTED;
    if (!shot->open || cdir_observer_poll(shot->observer, NULL) < 0 ||
        cdir_observer_shot_status(shot->observer, &status) < 0) {
        return;
    }
    answer->state = status.state;
    snprintf(answer->reason, sizeof answer->reason, "%.*s", (int)sizeof answer->reason - 1, status.reason);
    if (status.state != CDIR_SHOT_ACCEPTED || status.epoch != epoch) return;
    if (cdir_observer_newest_camera(shot->observer, &view) != CDIR_OK) return;
    if (view.frame_time < 0 || view.frame_time / ns_per_ms > INT32_MAX) return; /* no time of this server */
    *camera = camera_of(&view);
}

bool shots_poll(struct shots* shots, uint64_t epoch, struct director_report* report) {
    bool changed = false;
    for (uint32_t slot = 0; slot < max_slots; ++slot) {
        struct viewer_camera camera;
        struct viewer_shot answer;
        if (!shots->slots[slot].open && report->shots[slot].state == CDIR_SHOT_NOT_REQUESTED) continue;
        poll_shot(&shots->slots[slot], epoch, &camera, &answer);
        if (memcmp(&camera, &report->cameras[slot], sizeof camera) == 0 &&
            answer.state == report->shots[slot].state &&
            strcmp(answer.reason, report->shots[slot].reason) == 0) {
            continue;
        }
        report->cameras[slot] = camera;
        report->shots[slot] = answer;
        changed = true;
    }
    return changed;
}

uint32_t shots_behind(const struct shots* shots, const struct director_report* report, int32_t level_time) {
    uint32_t count = 0;
    for (uint32_t slot = 0; slot < max_slots; ++slot) {
        const struct viewer_camera* camera = &report->cameras[slot];
        if (shots->slots[slot].open && report->shots[slot].state == CDIR_SHOT_ACCEPTED &&
            (!camera->live || camera->level_time < level_time)) {
            ++count;
        }
    }
    return count;
}

void shots_close(struct shots* shots) {
    for (uint32_t slot = 0; slot < max_slots; ++slot) {
        close_shot(&shots->slots[slot]);
    }
}
