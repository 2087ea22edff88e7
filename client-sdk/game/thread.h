/* SPDX-License-Identifier: Apache-2.0 */
/* Threads and clocks. */
#ifndef CAMERA_DIRECTOR_GAME_THREAD_H
#define CAMERA_DIRECTOR_GAME_THREAD_H

#include <pthread.h>
#include <stdbool.h>
#include <stdint.h>
#include <time.h>

/* Starts a thread to which the process's signals are not delivered: they are the server's. That holds for the
 * threads that it starts, too. Returns false when that failed. */
bool thread_start(pthread_t* thread, void* (*run)(void*), void* argument);

/* The time in ns, without a system call for CLOCK_REALTIME and CLOCK_MONOTONIC. */
int64_t clock_ns(clockid_t clock);

#endif
