/* SPDX-License-Identifier: GPL-2.0-or-later */
#include "commands.h"

bool commands_console(void) {
    return false;
}

bool commands_client(int slot) {
    (void)slot;
    return false;
}
