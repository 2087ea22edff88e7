/* SPDX-License-Identifier: GPL-2.0-or-later */
/* `director ...` on the server's console and from clients: as a command, and in the chat as `!director ...`.
 */
#ifndef CAMERA_DIRECTOR_OPENARENA_COMMANDS_H
#define CAMERA_DIRECTOR_OPENARENA_COMMANDS_H

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Each returns true when the command in progress was one of the director's: the game must not see it. */
bool commands_console(void);
bool commands_client(int slot);

#ifdef __cplusplus
}
#endif

#endif
