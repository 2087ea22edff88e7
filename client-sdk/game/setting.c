/* SPDX-License-Identifier: Apache-2.0 */
#include "game/setting.h"

#include <ctype.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

uint32_t setting_domain(const char* value) {
    char* end = NULL;
    if (!isdigit((unsigned char)value[0])) return UINT32_MAX;
    const long domain = strtol(value, &end, 10);
    return *end == '\0' && domain <= INT_MAX ? (uint32_t)domain : UINT32_MAX;
}

void setting_text(char* text, size_t size, const char* name, const char* value, char* error,
                  size_t error_size) {
    const size_t length = strlen(value);
    if (length < size) {
        memcpy(text, value, length + 1);
    } else {
        snprintf(error, error_size, "%s is longer than %zu bytes", name, size - 1);
    }
}
