/* SPDX-License-Identifier: Apache-2.0 */
/* Values of a server's cvars: one that does not fit is an error, not another value. */
#ifndef CAMERA_DIRECTOR_GAME_SETTING_H
#define CAMERA_DIRECTOR_GAME_SETTING_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The number of a DDS domain, 0 to 230; for any other `value` UINT32_MAX, and `error` says so of the cvar
 * `name`. */
uint32_t setting_domain(const char* name, const char* value, char* error, size_t error_size);
/* Copies `value`; when it does not fit, `text` stays as it is and `error` says so of the cvar `name`. */
void setting_text(char* text, size_t size, const char* name, const char* value, char* error,
                  size_t error_size);

#ifdef __cplusplus
}
#endif

#endif
