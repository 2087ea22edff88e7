/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A bounded ring of places of one size between two threads: one only writes, the other only reads. No call
 * waits, locks, allocates or enters the kernel, except for create and destroy.
 */
#ifndef CAMERA_DIRECTOR_GAME_RING_H
#define CAMERA_DIRECTOR_GAME_RING_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

struct ring;

/* `capacity` is a power of two. Places are aligned for any type, and all 0 at first. Null when memory is
 * short. */
struct ring* ring_create(uint32_t capacity, size_t place_size);
void ring_destroy(struct ring* ring); /* may be null */

/* By the writer. The place to fill next, which may hold an earlier element; null unless more than `spare`
 * places are free. */
void* ring_free_place(struct ring* ring, uint32_t spare);
/* Hands that place to the reader. */
void ring_send(struct ring* ring);

/* By the reader. The oldest element that has not been released; null when there is none. */
const void* ring_oldest(const struct ring* ring);
/* Releases all but the newest element and returns that: it stays valid until the next call. Null when there
 * is none. */
const void* ring_newest(struct ring* ring);
/* Releases the oldest element, which there must be. */
void ring_release(struct ring* ring);

/* By either. Elements that are sent and not released. */
uint32_t ring_used(const struct ring* ring);

#ifdef __cplusplus
}
#endif

#endif
