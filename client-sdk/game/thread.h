/* SPDX-License-Identifier: Apache-2.0 */
/* The one thread of a module beside the game's, and clocks. */
#ifndef CAMERA_DIRECTOR_GAME_THREAD_H
#define CAMERA_DIRECTOR_GAME_THREAD_H

#include <stdbool.h>
#include <stdint.h>
#include <time.h>

#ifdef __cplusplus
extern "C" {
#endif

/* On the game's thread. Starts the worker, a thread that calls run(argument). The process's signals are not
 * delivered to it, nor to the threads that it starts: they are the server's. exit() stops it. Returns false
 * when there is no thread to be had. Not while a worker runs. */
bool worker_thread_start(void (*run)(void*), void* argument);
/* On the game's thread. Waits until the worker has returned from run(); does nothing when none was started.
 */
void worker_thread_stop(void);

/* On the worker. Whether run() must return. */
bool worker_thread_must_stop(void);
/* On the worker, once the client library has opened a context: exit() then stops the worker before it closes
 * all contexts. */
void worker_thread_stop_before_contexts(void);

/* The time in ns, without a system call for CLOCK_REALTIME and CLOCK_MONOTONIC. */
int64_t clock_ns(clockid_t clock);

#ifdef __cplusplus
}
#endif

#endif
