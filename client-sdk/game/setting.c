/* SPDX-License-Identifier: Apache-2.0 */
#include "game/setting.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

uint32_t setting_domain(const char* name, const char* value, char* error, size_t error_size) {
    static const long max_domain = 230;
    char* end = NULL;
    if (isdigit((unsigned char)value[0])) {
        const long domain = strtol(value, &end, 10);
        if (*end == '\0' && domain <= max_domain) return (uint32_t)domain;
    }
    snprintf(error, error_size, "%s '%.20s': expected a number from 0 to %ld", name, value, max_domain);
    return UINT32_MAX;
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
