/* SPDX-License-Identifier: GPL-2.0-or-later */
/*
 * The client prints "following NAME" with the name of the slot whose view it draws. With the director's
 * camera that is the viewer's own slot, so that this client alone is sent its slot's configstring with the
 * name of the camera's target in it.
 */
#ifndef CAMERA_DIRECTOR_OPENARENA_SHOWN_NAME_H
#define CAMERA_DIRECTOR_OPENARENA_SHOWN_NAME_H

#include <stdbool.h>
#include <stddef.h>

#include "frame.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { name_unsure = 254 }; /* as a slot: the client may show a name that is out of date */

/* Of one viewer. */
struct shown_name {
    uint8_t slot;      /* whose name is shown; no_slot = the viewer's own */
    int32_t sent_time; /* level time */
};

struct shown_name shown_name_own(void);
/* Sends the viewer the name of a slot, or its own back with no_slot, unless it is shown already. At most
 * twice a second: what is held back is sent by a later call. */
void shown_name_set(struct shown_name* shown, int viewer, uint8_t slot, int32_t level_time);
/* The game set the configstring of a player: the engine has sent it to the viewer, too. */
void shown_name_take_configstring(struct shown_name* shown, int viewer, uint8_t slot);

/* Stores the configstring of a player with the name of another in it. Returns false, and stores nothing, when
 * a name is missing or the result is too long to be sent. */
bool shown_name_replace(const char* own, const char* other, char* result, size_t size);

#ifdef __cplusplus
}
#endif

#endif
