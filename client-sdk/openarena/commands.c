/* SPDX-License-Identifier: GPL-2.0-or-later */
#define _POSIX_C_SOURCE 200809L
#include "commands.h"

#include <ctype.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "engine.h"
#include "proxy.h"
#include "roster.h"
#include "viewers.h"

enum { word_limit = 5, on_console = -1 };

static const char usage[] = "director auto | off | profile NAME | status";
static const char console_usage[] = "director status | auto SLOT | off SLOT | profile NAME SLOT";

/* A command's words, the first one is "director". */
struct words {
    int count;
    char words[word_limit][40];
};

/* --------------------------------------------------------------------------------------------- status */

static const char* choice_name(enum viewer_choice choice) {
    static const char* const names[] = {
        [choice_auto] = "auto", [choice_follow] = "follow", [choice_off] = "off"};
    return names[choice];
}

static const char* view_name(const struct viewer_status* viewer) {
    if (viewer->camera) return "the director's camera";
    return viewer->target == no_slot ? "free flight" : "the game's own view";
}

static void describe_viewer(int to, int slot, const struct viewer_status* viewer) {
    const struct director_report* const report = module_report();
    const char* const target = viewer->target < max_slots ? roster_at(viewer->target)->name : "nobody";
    char age[40] = "", shot[200] = "";
    if (viewer->camera) snprintf(age, sizeof age, ", %" PRId32 " ms old", viewer->camera_age);
    if (viewer->requests && report != NULL) {
        const struct viewer_shot* const answered = &report->shots[slot];
        snprintf(shot, sizeof shot, ", shot %s%s%s", cdir_shot_state_name(answered->state),
                 answered->reason[0] != '\0' ? ": " : "", answered->reason);
    }
    engine_print_line(to, "viewer %d %s: %s, profile %s, sees %s of %s%s%s", slot, roster_at(slot)->name,
                      choice_name(viewer->choice),
                      viewer->profile[0] != '\0' ? viewer->profile : "of the director", view_name(viewer),
                      target, age, shot);
}

static void describe_match(void) {
    const struct settings* const settings = module_settings();
    const struct director_report* const report = module_report();
    if (settings->match.error[0] == '\0')
        engine_print_line(on_console, "match %s, DDS domain %" PRIu32 ", interface %s, directors at %s",
                          settings->match.match_id, settings->match.domain, settings->match.network_interface,
                          settings->match.directors);
    engine_print_line(on_console, "map %s, life %" PRIu32, module_map(), module_life());
    if (!settings->match.enabled)
        engine_print_line(on_console, "director_enable is 0: nothing is published");
    else if (!settings->spectate)
        engine_print_line(on_console, "director_spectate is 0: spectators see the game's own views");
    if (report == NULL) {
        engine_print_line(on_console, "not connected yet");
        return;
    }
    engine_print_line(on_console, "epoch %" PRIu64 ", directors connected %" PRIu32, report->epoch,
                      report->directors);
    if (report->error[0] != '\0')
        engine_print_line(on_console, "error: %s", report->error);
    else if (report->directors == 0)
        engine_print_line(on_console,
                          "no director: is one running in DDS domain %" PRIu32
                          ", at one of these addresses, and do its settings let this interface in?",
                          settings->match.domain);
    engine_print_line(
        on_console,
        "published %" PRIu64 " frames, %" PRIu64 " events; skipped %" PRIu64 " frames, failed %" PRIu64,
        report->published_frames, report->published_events, report->skipped_frames, report->failures);
    if (report->recording_error[0] != '\0')
        engine_print_line(on_console, "recording: %s", report->recording_error);
    if (report->recorded_rows >= 0)
        engine_print_line(on_console, "recorded %" PRId64 " rows", report->recorded_rows);
}

static void describe_module(void) {
    const struct proxy_counters* const module = module_counters();
    const struct view_counters* const views = viewers_counters();
    const double mean =
        module->timed_frames > 0 ? (double)module->total_ns / 1e3 / (double)module->timed_frames : 0;
    engine_print_line(on_console,
                      "sampled %" PRIu64 " frames, %" PRIu64 " events; dropped %" PRIu64 " frames",
                      module->frames, module->events, module->dropped);
    engine_print_line(on_console, "shown %" PRIu64 " camera frames, %" PRIu64 " cuts, %" PRIu64 " fallbacks",
                      views->camera_frames, views->cuts, views->fallbacks);
    engine_print_line(on_console, "the game's thread spends %.1f us a frame here, at most %.1f us", mean,
                      (double)module->max_ns / 1e3);
}

static void print_status(void) {
    describe_match();
    for (int slot = 0; slot < max_slots; ++slot) {
        struct viewer_status viewer;
        if (viewers_status(slot, &viewer)) describe_viewer(on_console, slot, &viewer);
    }
    describe_module();
}

static void show_own_status(int slot) {
    struct viewer_status viewer;
    if (viewers_status(slot, &viewer)) {
        describe_viewer(slot, slot, &viewer);
    } else {
        engine_print_line(slot, "director: its camera is for spectators");
    }
}

/* ----------------------------------------------------------------------------------------- the choice */

static bool is_profile_name(const char* name) {
    for (; *name != '\0'; ++name) {
        if (!isalnum((unsigned char)*name) && strchr("-_.", *name) == NULL) return false;
    }
    return true;
}

/* Executes `words` for a slot and answers to `to`. Returns false when they are no choice. */
static bool choose(int to, int slot, const struct words* words, int count) {
    const char* const what = words->words[1];
    if (strcmp(what, "auto") == 0 && count == 2) {
        viewers_choose(slot, choice_auto);
        engine_print_line(to, "director: chooses the player");
    } else if (strcmp(what, "off") == 0 && count == 2) {
        viewers_choose(slot, choice_off);
        engine_print_line(to, "director: off");
    } else if (strcmp(what, "profile") == 0 && (count == 2 || count == 3)) {
        const char* const name = count == 3 ? words->words[2] : "";
        if (strlen(name) >= sizeof((struct viewer_request*)0)->profile || !is_profile_name(name)) {
            engine_print_line(to, "director: a profile's name has at most 31 letters, digits and -_.");
            return true;
        }
        viewers_choose_profile(slot, name);
        engine_print_line(to, "director: profile %s", name[0] != '\0' ? name : "of the server");
    } else {
        return false;
    }
    if (!module_settings()->spectate)
        engine_print_line(to, "director: switched off on this server (director_spectate 0)");
    return true;
}

/* -------------------------------------------------------------------------------- where it comes from */

static int slot_of(const char* text) {
    char* end = NULL;
    const long slot = strtol(text, &end, 10);
    return end != text && *end == '\0' && slot >= 0 && slot < max_slots ? (int)slot : -1;
}

bool commands_console(void) {
    struct words words = {0};
    struct viewer_status viewer;
    words.count = engine_argument_count();
    for (int i = 0; i < word_limit && i < words.count; ++i) {
        engine_argument(i, words.words[i], sizeof words.words[i]);
    }
    if (strcmp(words.words[0], "director") != 0) return false;
    if (words.count == 1 || (words.count == 2 && strcmp(words.words[1], "status") == 0)) {
        print_status();
        return true;
    }
    const int last = words.count - 1;
    const int slot = last < word_limit ? slot_of(words.words[last]) : -1;
    if (words.count < 3 || slot < 0) {
        engine_print_line(on_console, "usage: %s", console_usage);
    } else if (!viewers_status(slot, &viewer)) {
        engine_print_line(on_console, "director: slot %d is no human spectator", slot);
    } else if (!choose(on_console, slot, &words, last)) {
        engine_print_line(on_console, "usage: %s", console_usage);
    }
    return true;
}

/* Splits a line of chat, which is one argument or several, at its blanks. */
static struct words split(int first_argument) {
    struct words words = {0};
    char text[160];
    const int count = engine_argument_count();
    for (int i = first_argument; i < count && i < first_argument + word_limit; ++i) {
        char* state = NULL;
        engine_argument(i, text, sizeof text);
        for (const char* word = strtok_r(text, " \t", &state); word != NULL && words.count < word_limit;
             word = strtok_r(NULL, " \t", &state)) {
            snprintf(words.words[words.count++], sizeof words.words[0], "%s", word);
        }
    }
    return words;
}

static bool is_one_of(const char* word, const char* const* list) {
    while (*list != NULL && strcasecmp(word, *list) != 0) {
        ++list;
    }
    return *list != NULL;
}

/* The slot that an argument of the game's `follow` means, or no_slot. */
static uint8_t player_named(const char* text) {
    char name[sizeof((struct match_player*)0)->name];
    if (isdigit((unsigned char)text[0])) {
        const long slot = strtol(text, NULL, 10);
        return slot < max_slots ? (uint8_t)slot : no_slot;
    }
    roster_copy_name(name, sizeof name, text);
    for (int slot = 0; slot < max_slots; ++slot) {
        if (roster_at(slot)->in_use && strcasecmp(roster_at(slot)->name, name) == 0) return (uint8_t)slot;
    }
    return no_slot;
}

static bool take_follow(int slot, const char* name) {
    static const char* const cycle[] = {"follownext", "followprev", NULL};
    char text[sizeof((struct words*)0)->words[0]];
    if (is_one_of(name, cycle)) {
        viewers_take_follow(slot, follow_next, no_slot);
    } else if (strcasecmp(name, "follow") != 0) {
        return false;
    } else if (engine_argument_count() != 2) {
        viewers_take_follow(slot, follow_stop, no_slot);
    } else {
        engine_argument(1, text, sizeof text);
        viewers_take_follow(slot, follow_player, player_named(text));
    }
    return true;
}

bool commands_client(int slot) {
    static const char* const chat[] = {"say", "say_team", NULL};
    char name[40];
    engine_argument(0, name, sizeof name);
    if (take_follow(slot, name)) return false;
    const bool chats = is_one_of(name, chat);
    if (!chats && strcmp(name, "director") != 0) return false;
    const struct words words = split(chats ? 1 : 0);
    if (chats && strcmp(words.words[0], "!director") != 0) return false;
    if (words.count < 2 || (words.count == 2 && strcmp(words.words[1], "status") == 0)) {
        show_own_status(slot);
    } else if (!choose(slot, slot, &words, words.count)) {
        engine_print_line(slot, "usage: %s", usage);
    }
    return true;
}
