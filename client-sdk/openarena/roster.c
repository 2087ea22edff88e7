/* SPDX-License-Identifier: GPL-2.0-or-later */
#include "roster.h"

#include <stdlib.h>
#include <string.h>

#include "engine.h"
#include "frame.h"

static struct match_player entries[max_slots];
static uint32_t version;

void roster_reset(void) {
    memset(entries, 0, sizeof entries);
    ++version;
}

void roster_take_configstring(int number, const char* text) {
    const int slot = number - CONFIGSTRING_PLAYERS;
    if (slot < 0 || slot >= max_slots) return;
    const struct match_player entry = roster_parse(text == NULL ? "" : text);
    if (memcmp(&entry, &entries[slot], sizeof entry) == 0) return;
    entries[slot] = entry;
    ++version;
}

const struct match_player* roster_at(int slot) {
    return &entries[slot];
}

uint32_t roster_version(void) {
    return version;
}

void roster_copy_name(char* name, size_t size, const char* text) {
    size_t length = 0;
    for (; *text != '\0' && *text != '\\' && length + 1 < size; ++text) {
        if (text[0] == '^' /* a colour code: "^1" */ && text[1] != '\0' && text[1] != '\\' &&
            text[1] != '^') {
            ++text;
        } else if (*text >= 0x20 && *text < 0x7f) {
            name[length++] = *text;
        }
    }
    name[length] = '\0';
}

struct match_player roster_parse(const char* configstring) {
    struct match_player entry;
    memset(&entry, 0, sizeof entry); /* compared as bytes */
    const char* key = configstring;
    while (*key != '\0') {
        if (*key == '\\') ++key;
        const char* value = strchr(key, '\\');
        if (value == NULL) break;
        ++value;
        if (strncmp(key, "n\\", 2) == 0) {
            roster_copy_name(entry.name, sizeof entry.name, value);
        } else if (strncmp(key, "t\\", 2) == 0) {
            const int team = atoi(value);
            entry.team = team < team_free || team > team_spectator ? team_free : (uint8_t)team;
        }
        entry.in_use = 1;
        const char* next = strchr(value, '\\');
        if (next == NULL) break;
        key = next + 1;
    }
    return entry;
}
