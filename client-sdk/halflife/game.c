#include "game.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "game/thread.h"
#include "game_clock.h"
#include "messages.h"
#include "players.h"
#include "settings.h"
#include "worker.h"

enum { message_capacity = 64 };
static const double settings_interval = 1.0; /* s of game time; server.cfg is read after a map has begun */

static struct {
    struct worker* worker; /* null: no thread could be started */
    struct ring* messages;
    bool in_map;
    struct entity_list entities;
    struct match_state match;
    bool match_sent;
    struct game_clock clock;
    double settings_read_at, frame_due_at; /* s of game time; less than 0: at once */
    struct server_frame frame;             /* collects the events of the next frame */
    uint64_t dropped_frames, dropped_events;
} game;

/* Before a map, also of a server that publishes nothing yet: a frame must not wait for memory and a thread.
 */
static void start_worker(void) {
    if (game.worker != NULL) return;
    if (game.messages == NULL) game.messages = ring_create(message_capacity, sizeof(struct message));
    if (game.messages != NULL) game.worker = worker_start(game.messages);
    if (game.worker == NULL) engine_print("director: no thread could be started\n");
}

/* What was gathered for the next frame, and what it would be compared with. */
static void forget_frame(void) {
    game.frame.event_count = 0;
    players_reset();
}

void game_begin_map(struct entity* entities, int count, int max_clients,
                    int (*find_message)(const char* name)) {
    game.in_map = true;
    game.entities = (struct entity_list){entities, count, max_clients};
    ++game.match.life;
    snprintf(game.match.map, sizeof game.match.map, "%s", engine_map_name());
    game.match_sent = false;
    game.clock = (struct game_clock){0};
    game.settings_read_at = -1.0;
    game.frame_due_at = -1.0;
    forget_frame();
    messages_reset(find_message);
    start_worker();
}

static bool is_published(void) {
    return game.match.settings.enabled && game.match.settings.error[0] == '\0';
}

static void read_settings(double now) {
    if (game.settings_read_at >= 0.0 && now < game.settings_read_at + settings_interval) return;
    game.settings_read_at = now;
    const struct match_settings settings = settings_read();
    if (memcmp(&settings, &game.match.settings, sizeof settings) == 0) return;
    game.match.settings = settings;
    game.match_sent = false;
    game.frame_due_at = -1.0;
    if (!is_published()) forget_frame();
}

static void send_match(void) {
    struct match_player players[match_max_players];
    players_identify(&game.entities, players);
    if (memcmp(players, game.match.players, sizeof players) != 0) {
        memcpy(game.match.players, players, sizeof players);
        game.match_sent = false;
    }
    if (!game.match_sent)
        game.match_sent = message_ring_send(game.messages, message_match, &game.match, sizeof game.match);
}

/* Whether the greatest rate allows a frame now. */
static bool frame_is_due(double now) {
    const double tolerance = 0.0005; /* of a server whose frames come at exactly this rate */
    if (now < game.frame_due_at - tolerance) return false;
    const double interval = 1.0 / (double)game.match.settings.rate_hz;
    const double next = game.frame_due_at + interval;
    game.frame_due_at = next > now ? next : now + interval;
    return true;
}

void game_run_frame(void) {
    if (!game.in_map || game.worker == NULL) return;
    const double now = game_clock_advance(&game.clock, engine_time(), engine_frame_time());
    read_settings(now);
    send_match();
    if (!is_published() || !game.match_sent) return;
    players_damage(&game.entities, game_add_event);
    if (!frame_is_due(now)) return;
    game.frame.frame_time = (int64_t)(now * 1e9);
    game.frame.source_time = clock_ns(CLOCK_REALTIME);
    players_sample(&game.entities, now, &game.frame);
    if (message_ring_send(game.messages, message_frame, &game.frame, sizeof game.frame)) {
        game.frame.event_count = 0;
    } else {
        ++game.dropped_frames; /* its events go with the next frame */
        players_forget_poses();
    }
}

void game_end_map(void) {
    game.in_map = false;
    game.entities = (struct entity_list){NULL, 0, 0};
    if (game.messages != NULL) (void)message_ring_send(game.messages, message_end, NULL, 0);
}

uint32_t game_player_id(const struct entity* entity) {
    return players_id(&game.entities, entity);
}

void game_add_event(const struct game_event* event) {
    if (!game.in_map || !is_published()) return;
    if (game.frame.event_count == max_events) {
        ++game.dropped_events;
        return;
    }
    game.frame.events[game.frame.event_count++] = *event;
}

static void print_line(const char* name, const char* value) {
    char line[256];
    snprintf(line, sizeof line, "director %s: %s\n", name, value);
    engine_print(line);
}

static void print_number(const char* name, uint64_t value) {
    char text[24];
    snprintf(text, sizeof text, "%" PRIu64, value);
    print_line(name, text);
}

void game_print_status(void) {
    struct worker_status status = {0};
    if (game.worker != NULL) status = worker_read_status(game.worker);
    print_line("match", game.match.settings.match_id);
    print_line("map", game.in_map ? game.match.map : "none");
    print_line("state", game.worker == NULL            ? "no thread could be started"
                        : !game.match.settings.enabled ? "disabled"
                        : status.error[0] != '\0'      ? status.error
                        : status.open                  ? "publishing"
                                                       : "waiting for a map");
    print_number("directors", status.directors);
    print_number("frames published", status.published_frames);
    print_number("frames dropped", game.dropped_frames + status.dropped_frames);
    print_number("events published", status.published_events);
    print_number("events dropped", game.dropped_events + status.dropped_events);
}

void game_close(void) {
    game.in_map = false;
    if (game.worker != NULL) worker_stop(game.worker);
    ring_destroy(game.messages);
    game.worker = NULL;
    game.messages = NULL;
}
