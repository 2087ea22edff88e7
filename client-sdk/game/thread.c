/* SPDX-License-Identifier: Apache-2.0 */
#include "game/thread.h"

#include <pthread.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdlib.h>

static struct {
    void (*run)(void*);
    void* argument;
    pthread_t thread;
    bool started; /* by the game's thread */
    atomic_bool must_stop;
} worker;

static void* run(void* unused) {
    (void)unused;
    worker.run(worker.argument);
    return NULL;
}

/* A new thread inherits the blocked signals. */
static bool start_without_signals(void) {
    sigset_t all, before;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    const bool started = pthread_create(&worker.thread, NULL, run, NULL) == 0;
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    return started;
}

bool worker_thread_start(void (*run_worker)(void*), void* argument) {
    static bool registered; /* for a worker that never reaches the network */
    worker.run = run_worker;
    worker.argument = argument;
    atomic_store(&worker.must_stop, false);
    worker.started = start_without_signals();
    if (worker.started && !registered) registered = atexit(worker_thread_stop) == 0;
    return worker.started;
}

void worker_thread_stop(void) {
    if (!worker.started) return;
    atomic_store(&worker.must_stop, true);
    pthread_join(worker.thread, NULL);
    worker.started = false;
}

bool worker_thread_must_stop(void) {
    return atomic_load(&worker.must_stop);
}

/* Exit handlers run last to first: this one is registered after the client library's. */
void worker_thread_stop_before_contexts(void) {
    static bool registered;
    if (!registered) registered = atexit(worker_thread_stop) == 0;
}

int64_t clock_ns(clockid_t clock) {
    struct timespec time;
    clock_gettime(clock, &time);
    return (int64_t)time.tv_sec * 1000000000 + time.tv_nsec;
}
