/* SPDX-License-Identifier: Apache-2.0 */
/* Values of a server's cvars: one that does not fit is an error, not another value. */
#ifndef CAMERA_DIRECTOR_GAME_SETTING_H
#define CAMERA_DIRECTOR_GAME_SETTING_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The number of a DDS domain; UINT32_MAX when `value` is no number. The client library checks its range. */
uint32_t setting_domain(const char* value);
/* Copies `value`; when it does not fit, `text` stays as it is and `error` says so of the cvar `name`. */
void setting_text(char* text, size_t size, const char* name, const char* value, char* error,
                  size_t error_size);

#ifdef __cplusplus
}
#endif

#endif
