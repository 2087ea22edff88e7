/* SPDX-License-Identifier: GPL-2.0-or-later */
#include "events.h"

#include <stdlib.h>
#include <string.h>

#include "engine.h"

static struct {
    enum game_kind kind;
    struct vitals vitals[max_slots];
    /* Obituaries are temporary entities that stay for some frames. */
    struct obituary {
        int32_t type, victim, killer, means;
    } obituaries[max_entities];
    bool warmup, intermission, in_round, scored;
    int32_t round, scores[2];
} state;

static const char begin[] = "begin", end[] = "end";

const char* means_name(int means) {
    static const char* const names[] = {
        "MOD_UNKNOWN",        "MOD_SHOTGUN",      "MOD_GAUNTLET",      "MOD_MACHINEGUN", "MOD_GRENADE",
        "MOD_GRENADE_SPLASH", "MOD_ROCKET",       "MOD_ROCKET_SPLASH", "MOD_PLASMA",     "MOD_PLASMA_SPLASH",
        "MOD_RAILGUN",        "MOD_LIGHTNING",    "MOD_BFG",           "MOD_BFG_SPLASH", "MOD_WATER",
        "MOD_SLIME",          "MOD_LAVA",         "MOD_CRUSH",         "MOD_TELEFRAG",   "MOD_FALLING",
        "MOD_SUICIDE",        "MOD_TARGET_LASER", "MOD_TRIGGER_HURT",  "MOD_NAIL",       "MOD_CHAINGUN",
        "MOD_PROXIMITY_MINE", "MOD_KAMIKAZE",     "MOD_JUICED",        "MOD_GRAPPLE",
    };
    const int count = sizeof names / sizeof *names;
    return names[means > 0 && means < count ? means : 0];
}

enum game_kind events_game_kind(int game_type) {
    switch (game_type) {
        case 8: /* elimination */
        case 9: /* capture the flag with elimination */
            return game_with_rounds;
        case 0:  /* free for all */
        case 1:  /* duel */
        case 2:  /* single player */
        case 10: /* last man standing: its scores are players', and do not tell its rounds */
            return game_of_players;
        default:
            return game_of_teams;
    }
}

void events_reset(enum game_kind kind) {
    memset(&state, 0, sizeof state);
    state.kind = kind;
}

static uint32_t append(struct game_event events[max_events], uint32_t count, struct game_event event) {
    if (count == max_events) return count;
    events[count] = event;
    return count + 1;
}

void events_take_configstring(int number, const char* text) {
    const int32_t value = text == NULL ? 0 : atoi(text);
    if (number == CONFIGSTRING_WARMUP) {
        state.warmup = value != 0; /* the level time at which it ends, -1 while players are missing */
    } else if (number == CONFIGSTRING_INTERMISSION) {
        state.intermission = value != 0;
    } else if (number == CONFIGSTRING_RED_SCORE || number == CONFIGSTRING_BLUE_SCORE) {
        int32_t* score = &state.scores[number - CONFIGSTRING_RED_SCORE];
        if (value > *score) state.scored = true;
        *score = value;
    }
}

static uint8_t slot_of(int32_t entity_number) {
    return entity_number >= 0 && entity_number < max_slots ? (uint8_t)entity_number : no_slot;
}

struct vitals vitals_of(const uint8_t* player_state, const struct player_pose* pose) {
    static const int awards[award_count] = {PERSISTANT_IMPRESSIVE, PERSISTANT_EXCELLENT, PERSISTANT_DEFEND,
                                            PERSISTANT_ASSIST, PERSISTANT_GAUNTLET};
    struct vitals vitals;
    memset(&vitals, 0, sizeof vitals);
    if (!pose->in_game || pose->spectator) return vitals;
    vitals.present = 1;
    vitals.alive = pose->alive;
    vitals.health = read_element(player_state, PS_STATS, STAT_HEALTH);
    vitals.armor = read_element(player_state, PS_STATS, STAT_ARMOR);
    vitals.spawn_count = read_element(player_state, PS_PERSISTANT, PERSISTANT_SPAWN_COUNT);
    vitals.damage_event = read_int(player_state, PS_DAMAGE_EVENT);
    vitals.damage = read_int(player_state, PS_DAMAGE_COUNT);
    vitals.attacker = read_element(player_state, PS_PERSISTANT, PERSISTANT_ATTACKER);
    vitals.captures = read_element(player_state, PS_PERSISTANT, PERSISTANT_CAPTURES);
    for (int i = 0; i < award_count; ++i) {
        vitals.awards[i] = read_element(player_state, PS_PERSISTANT, (size_t)awards[i]);
    }
    for (int i = 0; i < power_up_count; ++i) {
        vitals.power_ups[i] = read_element(player_state, PS_POWERUPS, (size_t)i);
    }
    return vitals;
}

enum { red_flag = 7, neutral_flag = 9 };
/* Of what PS_POWERUPS holds. */
static const char* const item_names[power_up_count] = {
    NULL,         "item_quad",   "item_enviro",      "item_haste",        "item_invis",
    "item_regen", "item_flight", "team_CTF_redflag", "team_CTF_blueflag", "team_CTF_neutralflag",
    "item_scout", "item_guard",  "item_doubler",     "item_ammoregen",    NULL,
    NULL,
};

static const char* carried_flag(const struct vitals* vitals) {
    for (int i = red_flag; i <= neutral_flag; ++i) {
        if (vitals->power_ups[i] != 0) return item_names[i];
    }
    return "";
}

static uint32_t append_power_ups(struct game_event events[max_events], uint32_t count, uint8_t slot,
                                 const struct vitals* before, const struct vitals* now) {
    for (int i = 0; i < power_up_count; ++i) {
        const bool is_flag = i >= red_flag && i <= neutral_flag;
        const bool taken = is_flag ? before->power_ups[i] == 0 && now->power_ups[i] != 0
                                   : now->power_ups[i] > before->power_ups[i];
        if (item_names[i] == NULL || !taken) continue;
        const float team = is_flag ? (float)(i - red_flag + 1) : 0.0f; /* red, blue; 3 = the neutral flag */
        count = append(events, count,
                       (struct game_event){is_flag ? CDIR_EVENT_FLAG_TAKEN : CDIR_EVENT_ITEM, slot, no_slot,
                                           team, item_names[i]});
    }
    return count;
}

/* Of health and armor only what stands out, recognised by the jump: smaller items and regeneration add less.
 * A player who is nearly full already gains little and is not noticed. */
static uint32_t append_health_and_armor(struct game_event events[max_events], uint32_t count, uint8_t slot,
                                        const struct vitals* before, const struct vitals* now) {
    enum {
        least_mega_health = 51,
        most_ordinary_health = 100,
        least_combat_armor = 40,
        least_body_armor = 60
    };
    const int32_t health = now->health - before->health, armor = now->armor - before->armor;
    if (health >= least_mega_health && now->health > most_ordinary_health) {
        count =
            append(events, count,
                   (struct game_event){CDIR_EVENT_ITEM, slot, no_slot, (float)health, "item_health_mega"});
    }
    if (armor >= least_combat_armor) {
        const char* item = armor >= least_body_armor ? "item_armor_body" : "item_armor_combat";
        count =
            append(events, count, (struct game_event){CDIR_EVENT_ITEM, slot, no_slot, (float)armor, item});
    }
    return count;
}

uint32_t append_player_events(struct game_event events[max_events], uint32_t count, uint8_t slot,
                              const struct vitals* before, const struct vitals* now) {
    static const char* const awards[award_count] = {"impressive", "excellent", "defend", "assist",
                                                    "gauntlet"};
    if (!before->present || !now->present) return count;
    if (now->captures > before->captures) {
        count =
            append(events, count,
                   (struct game_event){CDIR_EVENT_FLAG_CAPTURED, slot, no_slot, 0.0f, carried_flag(before)});
    }
    for (int i = 0; i < award_count; ++i) {
        if (now->awards[i] <= before->awards[i]) continue;
        count = append(events, count, (struct game_event){CDIR_EVENT_AWARD, slot, no_slot, 0.0f, awards[i]});
    }
    if (now->spawn_count != before->spawn_count || !now->alive) return count;
    if (now->damage_event != before->damage_event && now->damage > 0) {
        count = append(
            events, count,
            (struct game_event){CDIR_EVENT_DAMAGE, slot_of(now->attacker), slot, (float)now->damage, ""});
    }
    count = append_power_ups(events, count, slot, before, now);
    return append_health_and_armor(events, count, slot, before, now);
}

/* The kill's points for its actor. */
static float kill_points(const struct player_pose players[max_slots], uint8_t killer, uint8_t victim) {
    if (killer == no_slot || victim == no_slot) return 0.0f;
    const bool same_side =
        killer == victim || (state.kind != game_of_players && players[killer].team != team_free &&
                             players[killer].team == players[victim].team);
    return same_side ? -1.0f : 1.0f;
}

static void append_kills(struct server_frame* frame) {
    const int entities = engine_entity_count();
    for (int number = max_slots; number < entities; ++number) {
        const uint8_t* entity = engine_entity(number);
        const int32_t type = read_int(entity, ENTITY_TYPE);
        struct obituary* last = &state.obituaries[number];
        if (type != ENTITY_TYPE_OBITUARY) {
            last->type = type;
            continue;
        }
        const struct obituary now = {type, read_int(entity, ENTITY_OTHER), read_int(entity, ENTITY_OTHER2),
                                     read_int(entity, ENTITY_EVENT_PARAMETER)};
        if (memcmp(&now, last, sizeof now) == 0) continue;
        *last = now;
        const uint8_t killer = slot_of(now.killer), victim = slot_of(now.victim);
        frame->event_count =
            append(frame->events, frame->event_count,
                   (struct game_event){CDIR_EVENT_KILL, killer, victim,
                                       kill_points(frame->players, killer, victim), means_name(now.means)});
    }
}

static void append_round(struct server_frame* frame, const char* detail) {
    state.in_round = detail == begin;
    if (state.in_round) ++state.round;
    frame->event_count =
        append(frame->events, frame->event_count,
               (struct game_event){CDIR_EVENT_ROUND, no_slot, no_slot, (float)state.round, detail});
}

/* A round is what lies between warm-up and intermission; where teams eliminate each other, it ends when a
 * side scores, and the next begins when the first player is spawned again. */
static void append_rounds(struct server_frame* frame, bool spawned) {
    const bool ended = state.intermission || state.warmup || (state.kind == game_with_rounds && state.scored);
    state.scored = false;
    if (state.in_round && ended) {
        append_round(frame, end);
    } else if (!state.in_round && !ended && spawned) {
        append_round(frame, begin);
    }
}

void events_sample(struct server_frame* frame) {
    bool spawned = false;
    append_kills(frame);
    for (int slot = 0; slot < max_slots; ++slot) {
        struct vitals* last = &state.vitals[slot];
        if (!frame->players[slot].in_game && !last->present) continue;
        const struct vitals now = vitals_of(engine_player_state(slot), &frame->players[slot]);
        spawned = spawned || now.spawn_count > last->spawn_count;
        frame->event_count =
            append_player_events(frame->events, frame->event_count, (uint8_t)slot, last, &now);
        *last = now;
    }
    append_rounds(frame, spawned);
}
