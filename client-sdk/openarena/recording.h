/* SPDX-License-Identifier: GPL-2.0-or-later */
/*
 * A match in files, one set a life, on the worker:
 *
 *     PREFIX-MAP-YYYYMMDD-HHMMSS.csv.gz          a row for each player and server frame, what
 *                                                `camera-director evaluate` reads
 *     PREFIX-MAP-YYYYMMDD-HHMMSS-events.csv.gz   t_ms,kind,actor,subject,value
 *     PREFIX-MAP-YYYYMMDD-HHMMSS-movers.csv.gz   t_ms,mover,x,y,z,pitch,yaw,roll; a row for each that moved
 *     PREFIX-MAP-YYYYMMDD-HHMMSS-players.csv     player,name,team,since_ms of everyone who took part: a row
 * for each name that a slot's player had, and for each new player in it
 *
 * Time counts from the first frame in all of them. Until they are complete their names end in ".part".
 */
#ifndef CAMERA_DIRECTOR_OPENARENA_RECORDING_H
#define CAMERA_DIRECTOR_OPENARENA_RECORDING_H

#include <stddef.h>
#include <time.h>

#include "exchange.h"

#ifdef __cplusplus
extern "C" {
#endif

struct recording;

/* Null: reason says why. `now` is the local time in the names. */
struct recording* recording_open(const char* prefix, const char* map, time_t now, char* reason,
                                 size_t reason_size);
/* Takes the players' names and teams from now on. */
void recording_set_players(struct recording* recording, const struct match_player players[max_slots]);
/* Returns false when it cannot be written: close it then. Frames of one life, in order. */
bool recording_add_frame(struct recording* recording, const struct server_frame* frame);
/* Pose rows so far. */
int64_t recording_rows(const struct recording* recording);
/* Completes the files and gives them their names. A recording without rows leaves none. Of one that cannot be
 * completed, what was written stays in the ".part" files: returns false, and a reason that names them. */
bool recording_close(struct recording* recording, char* reason, size_t reason_size);

/* One row each with its line end; returns its length. */
enum { max_row = 256 };
int pose_row(char row[max_row], int64_t t_ms, int slot, const struct player_pose* pose);
int event_row(char row[max_row], int64_t t_ms, const struct game_event* event);
int mover_row(char row[max_row], int64_t t_ms, const struct mover_pose* mover);

#ifdef __cplusplus
}
#endif

#endif
