/* The plugin's cvars. On the game's thread. */
#ifndef CAMERA_DIRECTOR_HALFLIFE_SETTINGS_H
#define CAMERA_DIRECTOR_HALFLIFE_SETTINGS_H

#include "game/match_state.h"

/* Registers the cvars with their defaults. Once, when the plugin is attached. */
void settings_register(void);
/* The present values. */
struct match_settings settings_read(void);

#endif
