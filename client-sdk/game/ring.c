/* SPDX-License-Identifier: Apache-2.0 */
#include "game/ring.h"

#include <stdalign.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

enum { cache_line = 64 };

/* Counts of elements since the start, which wrap; an element's place is its number modulo the capacity. The
 * writer alone stores `sent`, the reader alone `released`. */
struct ring {
    alignas(cache_line) _Atomic uint32_t sent;
    alignas(cache_line) _Atomic uint32_t released;
    alignas(cache_line) uint32_t capacity;
    size_t stride; /* between places, a multiple of cache_line */
    alignas(cache_line) unsigned char places[];
};

struct ring* ring_create(uint32_t capacity, size_t place_size) {
    const size_t stride = (place_size + cache_line - 1) / cache_line * cache_line;
    const size_t size = sizeof(struct ring) + capacity * stride;
    struct ring* ring = aligned_alloc(cache_line, size);
    if (ring == NULL) return NULL;
    memset(ring, 0, size);
    ring->capacity = capacity;
    ring->stride = stride;
    return ring;
}

void ring_destroy(struct ring* ring) {
    free(ring);
}

/* The counts as their own writer knows them. */
static uint32_t own(const _Atomic uint32_t* count) {
    return atomic_load_explicit(count, memory_order_relaxed);
}

static void* place_of(const struct ring* ring, uint32_t number) {
    return (unsigned char*)ring->places + number % ring->capacity * ring->stride;
}

uint32_t ring_used(const struct ring* ring) {
    /* The order of the loads keeps the difference from becoming negative. */
    const uint32_t released = atomic_load_explicit(&ring->released, memory_order_acquire);
    return atomic_load_explicit(&ring->sent, memory_order_acquire) - released;
}

void* ring_free_place(struct ring* ring, uint32_t spare) {
    return ring_used(ring) + spare >= ring->capacity ? NULL : place_of(ring, own(&ring->sent));
}

void ring_send(struct ring* ring) {
    atomic_store_explicit(&ring->sent, own(&ring->sent) + 1, memory_order_release);
}

const void* ring_oldest(const struct ring* ring) {
    return ring_used(ring) == 0 ? NULL : place_of(ring, own(&ring->released));
}

static void release(struct ring* ring, uint32_t count) {
    atomic_store_explicit(&ring->released, own(&ring->released) + count, memory_order_release);
}

const void* ring_newest(struct ring* ring) {
    const uint32_t used = ring_used(ring);
    if (used > 1) release(ring, used - 1);
    return used == 0 ? NULL : place_of(ring, own(&ring->released));
}

void ring_release(struct ring* ring) {
    release(ring, 1);
}
