/* SPDX-License-Identifier: GPL-2.0-or-later */
#include "shown_name.h"

#include <stdio.h>
#include <string.h>

#include "engine.h"

/* A client that takes no commands for a while is dropped when 64 of them wait. */
static const int32_t min_interval = 500;
/* The engine refuses commands of more than 1022 bytes. */
enum { max_configstring = 980 };

struct shown_name shown_name_own(void) {
    const struct shown_name shown = {no_slot, INT32_MIN};
    return shown;
}

/* The value of key "n" in "n\NAME\t\TEAM...", or null. */
static const char* find_name(const char* configstring) {
    if (strncmp(configstring, "n\\", 2) == 0) return configstring + 2;
    const char* const found = strstr(configstring, "\\n\\");
    return found == NULL ? NULL : found + 3;
}

bool shown_name_replace(const char* own, const char* other, char* result, size_t size) {
    const char* const own_name = find_name(own);
    const char* const other_name = find_name(other);
    if (own_name == NULL || other_name == NULL || strchr(own, '"') != NULL || strchr(other, '"') != NULL) {
        return false;
    }
    const size_t before = (size_t)(own_name - own), name = strcspn(other_name, "\\");
    const char* const after = own_name + strcspn(own_name, "\\");
    if (before + name + strlen(after) >= size) return false;
    snprintf(result, size, "%.*s%.*s%s", (int)before, own, (int)name, other_name, after);
    return true;
}

static void send_configstring(int viewer, uint8_t slot) {
    char own[configstring_size], other[configstring_size], shown[max_configstring],
        command[max_configstring + 20];
    engine_configstring(CONFIGSTRING_PLAYERS + viewer, own, sizeof own);
    engine_configstring(CONFIGSTRING_PLAYERS + (slot == no_slot ? viewer : slot), other, sizeof other);
    if (!shown_name_replace(own, other, shown, sizeof shown)) return;
    snprintf(command, sizeof command, "cs %d \"%s\"\n", CONFIGSTRING_PLAYERS + viewer, shown);
    engine_send_command(viewer, command);
}

void shown_name_set(struct shown_name* shown, int viewer, uint8_t slot, int32_t level_time) {
    if (shown->slot == slot || (int64_t)level_time - shown->sent_time < min_interval) return;
    shown->slot = slot;
    shown->sent_time = level_time;
    send_configstring(viewer, slot);
}

void shown_name_take_configstring(struct shown_name* shown, int viewer, uint8_t slot) {
    if (shown->slot == no_slot) return;
    /* The engine does not send what has not changed, so that the name may also be as it was. */
    if (slot == viewer || slot == shown->slot) shown->slot = name_unsure;
}
