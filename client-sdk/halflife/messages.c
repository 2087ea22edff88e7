#include "messages.h"

#include <string.h>

enum message_meaning {
    meaning_kill,   /* DeathMsg: byte killer (0 = the world), byte victim, ..., string means */
    meaning_pickup, /* ItemPickup: string class name; to the player who picked it up */
    meaning_round,  /* HLTV of Counter-Strike: bytes 0 0 as a round begins */
    meaning_count,
    meaning_none = meaning_count
};

static const char* const message_names[meaning_count] = {"DeathMsg", "ItemPickup", "HLTV"};
static int message_types[meaning_count];

static struct {
    enum message_meaning meaning;
    uint32_t receiver;
    uint32_t byte_count;
    int bytes[2];
    char text[32];
} message = {.meaning = meaning_none};

static uint32_t rounds;

void messages_reset(int (*find)(const char* name)) {
    for (int i = 0; i < meaning_count; ++i)
        message_types[i] = find(message_names[i]);
    message.meaning = meaning_none;
    rounds = 0;
}

static enum message_meaning meaning_of(int type) {
    for (int i = 0; i < meaning_count; ++i)
        if (type != 0 && message_types[i] == type) return (enum message_meaning)i;
    return meaning_none;
}

void messages_begin(int type, uint32_t receiver) {
    message.meaning = meaning_of(type);
    if (message.meaning == meaning_none) return;
    message.receiver = receiver;
    message.byte_count = 0;
    message.text[0] = '\0';
}

void messages_byte(int value) {
    if (message.meaning == meaning_none) return;
    if (message.byte_count < 2) message.bytes[message.byte_count] = value;
    ++message.byte_count;
}

void messages_text(const char* text) {
    if (message.meaning == meaning_none || text == NULL || message.text[0] != '\0') return;
    size_t length = 0;
    for (; text[length] != '\0' && length < sizeof message.text - 1; ++length)
        message.text[length] = text[length] >= 0x20 && text[length] < 0x7f ? text[length] : '?';
    message.text[length] = '\0';
}

static uint32_t player_or_none(int id) {
    return id >= 1 && id <= max_players ? (uint32_t)id : CDIR_NO_PLAYER;
}

bool messages_end(struct game_event* event) {
    const enum message_meaning meaning = message.meaning;
    message.meaning = meaning_none;
    *event = (struct game_event){.actor = CDIR_NO_PLAYER, .subject = CDIR_NO_PLAYER};
    memcpy(event->detail, message.text, sizeof event->detail);
    switch (meaning) {
        case meaning_kill:
            if (message.byte_count < 2) return false;
            event->kind = CDIR_EVENT_KILL;
            event->actor = player_or_none(message.bytes[0]);
            event->subject = player_or_none(message.bytes[1]);
            return event->subject != CDIR_NO_PLAYER;
        case meaning_pickup:
            event->kind = CDIR_EVENT_ITEM;
            event->actor = message.receiver;
            return event->actor != CDIR_NO_PLAYER;
        case meaning_round:
            if (message.byte_count != 2 || message.bytes[0] != 0 || message.bytes[1] != 0) return false;
            event->kind = CDIR_EVENT_ROUND;
            event->value = (float)++rounds;
            strcpy(event->detail, "begin");
            return true;
        default:
            return false;
    }
}
