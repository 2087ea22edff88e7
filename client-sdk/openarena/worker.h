/* SPDX-License-Identifier: GPL-2.0-or-later */
/*
 * The thread that talks to the directors and records. It lives as long as the process: over the ends of the
 * game's lives, and while the directors are away. It calls neither the engine nor the game.
 */
#ifndef CAMERA_DIRECTOR_OPENARENA_WORKER_H
#define CAMERA_DIRECTOR_OPENARENA_WORKER_H

#include "exchange.h"

/* Starts the thread; it ends when the process exits. Returns false when that failed. At most once. */
bool worker_start(struct exchange* exchange);

#endif
