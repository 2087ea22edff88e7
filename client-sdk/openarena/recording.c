/* SPDX-License-Identifier: GPL-2.0-or-later */
#define _POSIX_C_SOURCE 200809L
#include "recording.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <zlib.h>

enum { pose_file, event_file, mover_file, player_file, file_count };
enum { path_size = 512, suffix_size = 32 };

static const struct {
    const char *suffix, *header, *mode; /* T: plain text */
} kinds[file_count] = {
    {".csv.gz",
     "t_ms,player,x,y,z,pitch,yaw,roll,vx,vy,vz,viewheight,health,team,teleport_bit,alive,weapon\n", "wb3"},
    {"-events.csv.gz", "t_ms,kind,actor,subject,value\n", "wb3"},
    {"-movers.csv.gz", "t_ms,mover,x,y,z,pitch,yaw,roll\n", "wb3"},
    {"-players.csv", "player,name,team,since_ms\n", "wbT"},
};

struct recording {
    char path[path_size]; /* without a suffix */
    gzFile files[file_count];
    int64_t frames, rows;
    int32_t first_time; /* level time */
    int error;          /* errno of the first write that failed; 0 = none */
    struct match_player players[max_slots];
    struct occupant {
        struct match_player player; /* in_use: took part, and has no row yet */
        int64_t since;              /* ms */
        bool left;                  /* the slot was free since */
        uint8_t teleport_bit, toggle;
    } occupants[max_slots];
};

static void file_path(char path[path_size + suffix_size], const struct recording* recording, int kind,
                      const char* end) {
    snprintf(path, path_size + suffix_size, "%s%s%s", recording->path, kinds[kind].suffix, end);
}

static bool exists(const struct recording* recording) {
    char path[path_size + suffix_size];
    file_path(path, recording, pose_file, "");
    if (access(path, F_OK) == 0) return true;
    file_path(path, recording, pose_file, ".part");
    return access(path, F_OK) == 0;
}

/* Two lives may begin within one second. */
static void choose_path(struct recording* recording, const char* prefix, const char* map, time_t now) {
    char stamp[32], name[64];
    struct tm local;
    strftime(stamp, sizeof stamp, "%Y%m%d-%H%M%S", localtime_r(&now, &local));
    snprintf(name, sizeof name, "%s", map);
    for (char* c = name; *c != '\0'; ++c) {
        if (*c == '/') *c = '_';
    }
    snprintf(recording->path, path_size, "%s-%s-%s", prefix, name, stamp);
    for (int number = 2; exists(recording) && number < 100; ++number) {
        snprintf(recording->path, path_size, "%s-%s-%s-%d", prefix, name, stamp, number);
    }
}

/* Closes what is open and removes it. */
static void discard(struct recording* recording) {
    char path[path_size + suffix_size];
    for (int kind = 0; kind < file_count; ++kind) {
        if (recording->files[kind] != NULL) gzclose(recording->files[kind]);
        file_path(path, recording, kind, ".part");
        unlink(path);
    }
    free(recording);
}

struct recording* recording_open(const char* prefix, const char* map, time_t now, char* reason,
                                 size_t reason_size) {
    struct recording* recording = calloc(1, sizeof *recording);
    if (recording == NULL) {
        snprintf(reason, reason_size, "no memory for a recording");
        return NULL;
    }
    choose_path(recording, prefix, map, now);
    for (int kind = 0; kind < file_count; ++kind) {
        char path[path_size + suffix_size];
        file_path(path, recording, kind, ".part");
        recording->files[kind] = gzopen(path, kinds[kind].mode);
        if (recording->files[kind] == NULL || gzputs(recording->files[kind], kinds[kind].header) < 0) {
            snprintf(reason, reason_size, "cannot record to %s: %s", path, strerror(errno));
            discard(recording);
            return NULL;
        }
    }
    return recording;
}

void recording_set_players(struct recording* recording, const struct match_player players[max_slots]) {
    memcpy(recording->players, players, sizeof recording->players);
    for (int slot = 0; slot < max_slots; ++slot) {
        if (!players[slot].in_use) recording->occupants[slot].left = true;
    }
}

int64_t recording_rows(const struct recording* recording) {
    return recording->rows;
}

int pose_row(char row[max_row], int64_t t_ms, int slot, const struct player_pose* pose) {
    return snprintf(row, max_row, "%lld,%d,%.2f,%.2f,%.2f,%.2f,%.2f,%.2f,%.1f,%.1f,%.1f,%d,%d,%d,%d,%d,%d\n",
                    (long long)t_ms, slot, pose->origin[0], pose->origin[1], pose->origin[2], pose->angles[0],
                    pose->angles[1], pose->angles[2], pose->velocity[0], pose->velocity[1], pose->velocity[2],
                    pose->viewheight, pose->health, pose->team, pose->teleport_bit, pose->alive,
                    pose->weapon);
}

int event_row(char row[max_row], int64_t t_ms, const struct game_event* event) {
    static const char* const names[] = {"",       "kill",  "flag_taken", "flag_captured", "objective",
                                        "damage", "award", "item",       "round"};
    const char* kind = names[event->kind < sizeof names / sizeof *names ? event->kind : 0];
    if (event->kind == CDIR_EVENT_KILL && (event->actor == no_slot || event->actor == event->subject)) {
        kind = "death";
    }
    char actor[8] = "", subject[8] = "", value[40];
    if (event->actor != no_slot) snprintf(actor, sizeof actor, "%d", event->actor);
    if (event->subject != no_slot) snprintf(subject, sizeof subject, "%d", event->subject);
    if (event->detail[0] != '\0') {
        snprintf(value, sizeof value, "%s", event->detail);
    } else {
        snprintf(value, sizeof value, "%g", event->value);
    }
    return snprintf(row, max_row, "%lld,%s,%s,%s,%s\n", (long long)t_ms, kind, actor, subject, value);
}

int mover_row(char row[max_row], int64_t t_ms, const struct mover_pose* mover) {
    return snprintf(row, max_row, "%lld,%d,%.2f,%.2f,%.2f,%.2f,%.2f,%.2f\n", (long long)t_ms, mover->model,
                    mover->origin[0], mover->origin[1], mover->origin[2], mover->angles[0], mover->angles[1],
                    mover->angles[2]);
}

static bool write_row(struct recording* recording, int kind, const char* row, int length) {
    errno = 0;
    if (length > 0 && length < max_row && gzwrite(recording->files[kind], row, (unsigned)length) == length) {
        return true;
    }
    if (recording->error == 0) recording->error = errno != 0 ? errno : EIO;
    return false;
}

static void write_occupant(struct recording* recording, int slot) {
    char row[max_row];
    struct occupant* occupant = &recording->occupants[slot];
    struct match_player* player = &occupant->player;
    if (!player->in_use) return;
    for (char* c = player->name; *c != '\0'; ++c) {
        if (*c == ',' || *c == '"') *c = '_';
    }
    (void)write_row(recording, player_file, row,
                    snprintf(row, sizeof row, "%d,%s,%d,%lld\n", slot, player->name, player->team,
                             (long long)occupant->since));
}

/* Another player than before in this slot gets a row of their own, and does not go on from where the former
 * one was: their first pose is a teleport. */
static void take_in_player(struct recording* recording, int slot, int64_t time, uint8_t teleport_bit) {
    struct occupant* occupant = &recording->occupants[slot];
    const struct match_player* player = &recording->players[slot];
    const bool seen = occupant->player.in_use;
    if (!seen || occupant->left || strcmp(occupant->player.name, player->name) != 0) {
        if (seen && occupant->left && teleport_bit == occupant->teleport_bit) occupant->toggle ^= 1;
        write_occupant(recording, slot);
        occupant->since = time;
        occupant->left = false;
    }
    occupant->player = *player;
    occupant->teleport_bit = teleport_bit;
}

bool recording_add_frame(struct recording* recording, const struct server_frame* frame) {
    char row[max_row];
    bool good = true;
    if (recording->frames++ == 0) recording->first_time = frame->level_time;
    const int64_t time = (int64_t)frame->level_time - recording->first_time;
    for (int slot = 0; slot < max_slots && good; ++slot) {
        struct player_pose pose = frame->players[slot];
        if (!pose.in_game || pose.spectator) continue;
        take_in_player(recording, slot, time, pose.teleport_bit);
        pose.teleport_bit ^= recording->occupants[slot].toggle;
        good = write_row(recording, pose_file, row, pose_row(row, time, slot, &pose));
        ++recording->rows;
    }
    for (uint32_t i = 0; i < frame->event_count && good; ++i) {
        good = write_row(recording, event_file, row, event_row(row, time, &frame->events[i]));
    }
    for (uint32_t i = 0; i < frame->mover_count && good; ++i) {
        good = write_row(recording, mover_file, row, mover_row(row, time, &frame->movers[i]));
    }
    return good;
}

/* The poses get their name last: where they are, all of the set is. */
static bool name_files(struct recording* recording) {
    for (int kind = file_count - 1; kind >= 0; --kind) {
        char from[path_size + suffix_size], to[path_size + suffix_size];
        file_path(from, recording, kind, ".part");
        file_path(to, recording, kind, "");
        if (rename(from, to) != 0) {
            recording->error = errno;
            return false;
        }
    }
    return true;
}

static bool close_files(struct recording* recording) {
    bool good = true;
    for (int kind = 0; kind < file_count; ++kind) {
        errno = 0;
        good = gzclose(recording->files[kind]) == Z_OK && good;
        if (recording->error == 0) recording->error = errno;
        recording->files[kind] = NULL;
    }
    return good;
}

bool recording_close(struct recording* recording, char* reason, size_t reason_size) {
    for (int slot = 0; slot < max_slots; ++slot) {
        write_occupant(recording, slot);
    }
    const bool written = recording->error == 0;
    const bool closed = close_files(recording);
    if (recording->rows == 0) {
        discard(recording);
        return true;
    }
    const bool good = written && closed && name_files(recording);
    if (!good) {
        snprintf(reason, reason_size, "cannot write: %s; what was recorded is kept in %s*.part",
                 strerror(recording->error), recording->path);
    }
    free(recording);
    return good;
}
