/* SPDX-License-Identifier: GPL-2.0-or-later */
/* Preloaded into a game client: logs, for every picture that it shows, the matrices that it was drawn with,
 * the newest packet that the client had read before, and where pixels have the marker's colour. It changes
 * nothing. CAMDIR_DRAWN_VIEWS names the file, which receives struct drawn_record. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/types.h>
#include <time.h>

#include "support/game/records.h"

#define EXPORTED __attribute__((visibility("default")))

enum {
    gl_viewport = 0x0ba2,
    gl_modelview = 0x1700,
    gl_projection = 0x1701,
    gl_rgba = 0x1908,
    gl_unsigned_byte = 0x1401
};

static void (*gl_load_matrix)(const float*);
static void (*gl_matrix_mode)(unsigned);
static void (*gl_read_pixels)(int, int, int, int, unsigned, unsigned, void*);
static void (*gl_get_integers)(unsigned, int*);

static unsigned matrix_mode = gl_modelview;
static struct drawn_record picture;
static FILE* log_file;
static unsigned char* pixels;

static int64_t now(void) {
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (int64_t)time.tv_sec * 1000000000 + time.tv_nsec;
}

/* The renderer loads the matrix of each model before drawing it, and the map's last. */
static void load_matrix(const float* matrix) {
    if (matrix_mode == gl_projection) {
        const int perspective = matrix[11] == -1.0F;
        if (perspective) memcpy(picture.projection, matrix, sizeof picture.projection);
    } else {
        memcpy(picture.view, matrix, sizeof picture.view);
        if (picture.entity_count < drawn_entities) {
            memcpy(picture.entities[picture.entity_count++], matrix + 12, 3 * sizeof(float));
        }
    }
    gl_load_matrix(matrix);
}

static void set_matrix_mode(unsigned mode) {
    matrix_mode = mode;
    gl_matrix_mode(mode);
}

/* Not ISO C, which has no conversion between pointers to objects and to functions. */
static void* address(void (*function)(void)) {
    void* result;
    memcpy(&result, &function, sizeof result);
    return result;
}

EXPORTED void* SDL_GL_GetProcAddress(const char* name) {
    static void* (*real)(const char*);
    if (!real) *(void**)&real = dlsym(RTLD_NEXT, "SDL_GL_GetProcAddress");
    void* found = real(name);
    if (strcmp(name, "glLoadMatrixf") == 0) {
        *(void**)&gl_load_matrix = found;
        return address((void (*)(void))load_matrix);
    }
    if (strcmp(name, "glMatrixMode") == 0) {
        *(void**)&gl_matrix_mode = found;
        return address((void (*)(void))set_matrix_mode);
    }
    if (!gl_read_pixels) {
        *(void**)&gl_read_pixels = real("glReadPixels");
        *(void**)&gl_get_integers = real("glGetIntegerv");
    }
    return found;
}

static void find_marker(void) {
    int viewport[4];
    gl_get_integers(gl_viewport, viewport);
    const int width = picture.width = viewport[2], height = picture.height = viewport[3];
    pixels = realloc(pixels, (size_t)width * (size_t)height * 4);
    gl_read_pixels(0, 0, width, height, gl_rgba, gl_unsigned_byte, pixels);
    picture.marker_pixels = 0;
    picture.marker_left = width;
    picture.marker_top = height;
    picture.marker_right = picture.marker_bottom = -1;
    for (int row = 0; row < height; ++row) { /* row 0 is the lowest */
        const int y = height - 1 - row;
        for (int x = 0; x < width; ++x) {
            const unsigned char* p = pixels + ((size_t)row * (size_t)width + (size_t)x) * 4;
            if (p[0] < 240 || p[1] > 15 || p[2] < 240) continue;
            ++picture.marker_pixels;
            if (x < picture.marker_left) picture.marker_left = x;
            if (x > picture.marker_right) picture.marker_right = x;
            if (y < picture.marker_top) picture.marker_top = y;
            if (y > picture.marker_bottom) picture.marker_bottom = y;
        }
    }
}

EXPORTED void SDL_GL_SwapWindow(void* window) {
    static void (*real)(void*);
    if (!real) *(void**)&real = dlsym(RTLD_NEXT, "SDL_GL_SwapWindow");
    const char* file = getenv("CAMDIR_DRAWN_VIEWS");
    if (!log_file && file) log_file = fopen(file, "ab");
    if (log_file && picture.entity_count > 0 && gl_read_pixels) {
        find_marker();
        picture.time = now();
        fwrite(&picture, sizeof picture, 1, log_file);
        fflush(log_file);
    }
    picture.entity_count = 0;
    real(window);
}

/* Declared here, because the system's header gives the addresses a type that no definition can have. */
EXPORTED ssize_t recvfrom(int socket, void* buffer, size_t size, int flags, void* from, void* from_size) {
    enum { family_internet = 2 };
    static ssize_t (*real)(int, void*, size_t, int, void*, void*);
    if (!real) *(void**)&real = dlsym(RTLD_NEXT, "recvfrom");
    const ssize_t count = real(socket, buffer, size, flags, from, from_size);
    uint16_t family = 0;
    uint32_t sequence = 0;
    if (count < 4 || !from) return count;
    memcpy(&family, from, sizeof family);
    memcpy(&sequence, buffer, sizeof sequence);
    /* -1 begins a packet outside the connection; the highest bit marks a fragment. */
    if (family == family_internet && sequence != UINT32_MAX) {
        picture.packet = sequence & 0x7fffffffU;
        picture.packet_time = now();
    }
    return count;
}
