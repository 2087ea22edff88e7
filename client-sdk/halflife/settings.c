#include "settings.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "engine.h"

enum cvar_number { enable, match, domain, interface, directors, max_rate, cvar_count };

static struct cvar cvars[cvar_count] = {
    [enable] = {.name = "director_enable", .text = "1", .flags = cvar_of_game},
    [match] = {.name = "director_match", .text = "", .flags = cvar_of_game},
    [domain] = {.name = "director_domain", .text = "0", .flags = cvar_of_game},
    [interface] = {.name = "director_interface", .text = "lo", .flags = cvar_of_game},
    [directors] = {.name = "director_directors", .text = "127.0.0.1", .flags = cvar_of_game},
    [max_rate] = {.name = "director_max_rate", .text = "100", .flags = cvar_of_game},
};
/* Metamod may register copies, so that a plugin can be unloaded: values are read where the engine keeps them.
 */
static const struct cvar* registered[cvar_count];
static const struct cvar* server_port;

void settings_register(void) {
    for (int i = 0; i < cvar_count; ++i) {
        engine_register_cvar(&cvars[i]);
        registered[i] = engine_find_cvar(cvars[i].name);
        if (registered[i] == NULL) registered[i] = &cvars[i];
    }
    server_port = engine_find_cvar("port");
}

static void copy_text(char* to, size_t size, enum cvar_number from) {
    const char* text = registered[from]->text;
    snprintf(to, size, "%s", text != NULL ? text : "");
}

struct settings settings_read(void) {
    struct settings settings;
    memset(&settings, 0, sizeof settings);
    settings.enabled = registered[enable]->value != 0.0f ? 1u : 0u;
    const float number = registered[domain]->value;
    settings.domain = number >= 0.0f && number <= 230.0f ? (uint32_t)number : 0u;
    const float rate = registered[max_rate]->value;
    settings.max_rate_hz = rate >= 1.0f && rate <= 1000.0f ? rate : 100.0f;
    copy_text(settings.match, sizeof settings.match, match);
    copy_text(settings.network_interface, sizeof settings.network_interface, interface);
    copy_text(settings.directors, sizeof settings.directors, directors);
    if (settings.match[0] == '\0') {
        const char* port = server_port != NULL && server_port->text != NULL ? server_port->text : "0";
        snprintf(settings.match, sizeof settings.match, "halflife-%s", port);
    }
    return settings;
}
