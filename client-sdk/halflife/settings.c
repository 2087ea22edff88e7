#include "settings.h"

#include <stdio.h>
#include <string.h>

#include "engine.h"
#include "game/setting.h"

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

static const char* value_of(enum cvar_number number) {
    const char* text = registered[number]->text;
    return text != NULL ? text : "";
}

static void read_text(struct match_settings* settings, enum cvar_number number, char* text, size_t size) {
    setting_text(text, size, cvars[number].name, value_of(number), settings->error, sizeof settings->error);
}

struct match_settings settings_read(void) {
    struct match_settings settings;
    memset(&settings, 0, sizeof settings);
    settings.enabled = registered[enable]->value != 0.0f ? 1u : 0u;
    settings.domain =
        setting_domain(cvars[domain].name, value_of(domain), settings.error, sizeof settings.error);
    settings.rate_hz = registered[max_rate]->value;
    if (!(settings.rate_hz >= 1.0f && settings.rate_hz <= 1000.0f))
        snprintf(settings.error, sizeof settings.error, "director_max_rate must be 1 to 1000");
    read_text(&settings, match, settings.match_id, sizeof settings.match_id);
    read_text(&settings, interface, settings.network_interface, sizeof settings.network_interface);
    read_text(&settings, directors, settings.directors, sizeof settings.directors);
    if (settings.match_id[0] == '\0') {
        const char* port = server_port != NULL && server_port->text != NULL ? server_port->text : "0";
        snprintf(settings.match_id, sizeof settings.match_id, "halflife-%s", port);
    }
    return settings;
}
