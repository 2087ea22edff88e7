#include "quakeworld/messages.hpp"

#include <cmath>
#include <string>

namespace camdir::quakeworld {
namespace {

enum Number : std::uint8_t {
    msg_nop = 1,
    msg_disconnect = 2,
    msg_stat = 3,
    msg_set_view = 5,
    msg_sound = 6,
    msg_print = 8,
    msg_client_command = 9,
    msg_set_angle = 10,
    msg_begin_level = 11,
    msg_light_style = 12,
    msg_frags = 14,
    msg_stop_sound = 16,
    msg_view_damage = 19,
    msg_static_entity = 20,
    msg_static_entity_delta = 21,
    msg_baseline = 22,
    msg_temporary_entity = 23,
    msg_pause = 24,
    msg_centre_print = 26,
    msg_killed_monster = 27,
    msg_found_secret = 28,
    msg_static_sound = 29,
    msg_intermission = 30,
    msg_finale = 31,
    msg_cd_track = 32,
    msg_sell_screen = 33,
    msg_small_kick = 34,
    msg_big_kick = 35,
    msg_ping = 36,
    msg_enter_time = 37,
    msg_long_stat = 38,
    msg_muzzle_flash = 39,
    msg_user_info = 40,
    msg_player = 42,
    msg_nails = 43,
    msg_choke_count = 44,
    msg_models = 45,
    msg_sounds = 46,
    msg_entities = 47,
    msg_entities_delta = 48,
    msg_max_speed = 49,
    msg_gravity = 50,
    msg_user_key = 51,
    msg_server_key = 52,
    msg_packet_loss = 53,
    msg_numbered_nails = 54,
    msg_models_wide = 60,
    msg_baseline_delta = 66,
    msg_voice = 84,
};

constexpr std::int32_t protocol_version = 28;
constexpr std::int32_t fte_extensions = 0x58455446;    // "FTEX"
constexpr std::int32_t fte_2_extensions = 0x32455446;  // "FTE2"
constexpr std::int32_t mvd_extensions = 0x3144564d;    // "MVD1"
constexpr std::uint32_t fte_float_coordinates = 0x8000;
constexpr std::uint32_t mvd_float_coordinates = 1;

constexpr float largest_coordinate = 1e6F;

constexpr std::uint16_t damage_section = 7;

std::optional<std::uint8_t> client_of(std::uint16_t entity) {
    if (entity < 1 || entity > max_slots) return std::nullopt;
    return static_cast<std::uint8_t>(entity - 1);
}

}  // namespace

Result<Message> MessageReader::next() {
    const std::string place = "byte " + std::to_string(cursor_.offset()) + " of the block: message ";
    const std::uint8_t number = cursor_.u8();
    begins_level_ = number == msg_begin_level;
    auto message = read(number);
    if (!message) return fail(place + std::to_string(number) + message.error().message);
    if (!cursor_.ok()) return fail(place + std::to_string(number) + " ends early");
    if (invalid_) return fail(place + std::to_string(number) + " has a coordinate or a slot out of range");
    return message;
}

Result<Message> MessageReader::read(std::uint8_t number) {
    switch (number) {
        case msg_player:
            return player_info();
        case msg_stat: {
            const std::uint8_t stat = cursor_.u8();
            return Stat{stat, cursor_.u8()};
        }
        case msg_long_stat: {
            const std::uint8_t stat = cursor_.u8();
            return Stat{stat, cursor_.i32()};
        }
        case msg_print: {
            const std::uint8_t level = cursor_.u8();
            return Print{level, cursor_.text()};
        }
        case msg_client_command:
            return ClientCommand{cursor_.text()};
        case msg_user_info: {
            const std::uint8_t slot = cursor_.u8();
            invalid_ = slot >= max_slots;
            cursor_.take(4);
            return UserInfo{slot, cursor_.text()};
        }
        case msg_user_key: {
            const std::uint8_t slot = cursor_.u8();
            invalid_ = slot >= max_slots;
            const std::string_view key = cursor_.text();
            return UserKey{slot, key, cursor_.text()};
        }
        case msg_server_key: {
            const std::string_view key = cursor_.text();
            return ServerKey{key, cursor_.text()};
        }
        case msg_models:
            return models(false);
        case msg_models_wide:
            return models(true);
        case msg_sounds:
            models(false);
            return Other{};
        case msg_begin_level:
            return begin_level();
        case msg_intermission:
            skip_coordinates(3);
            skip_angles(3);
            return Intermission{};
        case msg_entities:
            return entities();
        case msg_entities_delta:
            cursor_.take(1);
            return entities();
        case msg_static_entity_delta:
        case msg_baseline_delta:
            if (auto skipped = entity(cursor_.u16()); !skipped) return tl::unexpected(skipped.error());
            return Other{};
        case msg_temporary_entity:
            return temporary_entity();
        default:
            return read_fixed(number);
    }
}

// What only has to be skipped.
Result<Message> MessageReader::read_fixed(std::uint8_t number) {
    switch (number) {
        case msg_nop:
        case msg_killed_monster:
        case msg_found_secret:
        case msg_sell_screen:
        case msg_small_kick:
        case msg_big_kick:
            break;
        case msg_pause:
        case msg_cd_track:
        case msg_choke_count:
            cursor_.take(1);
            break;
        case msg_set_view:
        case msg_stop_sound:
        case msg_muzzle_flash:
        case msg_packet_loss:
            cursor_.take(2);
            break;
        case msg_frags:
        case msg_ping:
            cursor_.take(3);
            break;
        case msg_max_speed:
        case msg_gravity:
            cursor_.take(4);
            break;
        case msg_enter_time:
            cursor_.take(5);
            break;
        case msg_disconnect:
            cursor_.text();
            cursor_.take(cursor_.left());
            break;
        case msg_centre_print:
        case msg_finale:
            cursor_.text();
            break;
        case msg_light_style:
            cursor_.take(1);
            cursor_.text();
            break;
        case msg_set_angle:
            cursor_.take(1);
            skip_angles(3);
            break;
        case msg_sound: {
            const std::uint16_t channel = cursor_.u16();
            cursor_.take(1U + ((channel & 0x8000U) != 0) + ((channel & 0x4000U) != 0));
            skip_coordinates(3);
            break;
        }
        case msg_view_damage:
            cursor_.take(2);
            skip_coordinates(3);
            break;
        case msg_static_entity:
        case msg_baseline:
            cursor_.take(number == msg_baseline ? 6 : 4);
            for (int axis = 0; axis < 3; ++axis) {
                skip_coordinates(1);
                skip_angles(1);
            }
            break;
        case msg_static_sound:
            skip_coordinates(3);
            cursor_.take(3);
            break;
        case msg_nails:
            cursor_.take(std::size_t{6} * cursor_.u8());
            break;
        case msg_numbered_nails:
            cursor_.take(std::size_t{7} * cursor_.u8());
            break;
        case msg_voice:
            cursor_.take(3);
            cursor_.take(cursor_.u16());
            break;
        default:
            return fail(" is unknown");
    }
    return Other{};
}

Message MessageReader::player_info() {
    enum Flag : std::uint16_t {
        first_origin = 1U << 0U,
        first_angle = 1U << 3U,
        effects = 1U << 6U,
        skin = 1U << 7U,
        dead = 1U << 8U,
        gibbed = 1U << 9U,
        weapon_frame = 1U << 10U,
        model = 1U << 11U,
    };
    PlayerInfo info;
    info.slot = cursor_.u8();
    const std::uint16_t flags = cursor_.u16();
    cursor_.take(1);
    for (std::size_t axis = 0; axis < 3; ++axis)
        if ((flags & (first_origin << axis)) != 0) info.origin[axis] = coordinate();
    for (std::size_t axis = 0; axis < 3; ++axis)
        if ((flags & (first_angle << axis)) != 0)
            info.angles[axis] = static_cast<float>(cursor_.i16()) * (360.0F / 65536.0F);
    if ((flags & model) != 0) info.model = cursor_.u8();
    for (const Flag flag : {skin, effects, weapon_frame})
        if ((flags & flag) != 0) cursor_.take(1);
    info.dead = (flags & dead) != 0;
    info.gibbed = (flags & gibbed) != 0;
    invalid_ = invalid_ || info.slot >= max_slots;
    return info;
}

Message MessageReader::models(bool wide_number) {
    Models models;
    models.first = 1U + (wide_number ? cursor_.u16() : cursor_.u8());
    for (auto name = cursor_.text(); !name.empty(); name = cursor_.text())
        models.names.push_back(name);
    cursor_.take(1);
    return models;
}

Message MessageReader::temporary_entity() {
    enum Kind : std::uint8_t {
        gunshot = 2,
        lightning_1 = 5,
        lightning_2 = 6,
        lightning_3 = 9,
        teleport = 11,
        blood = 12
    };
    switch (cursor_.u8()) {
        case teleport: {
            TeleportFlash flash;
            for (int axis = 0; axis < 3; ++axis)
                flash.position[axis] = coordinate();
            return flash;
        }
        case lightning_1:
        case lightning_2:
        case lightning_3:
            cursor_.take(2);
            skip_coordinates(6);
            break;
        case gunshot:
        case blood:
            cursor_.take(1);
            skip_coordinates(3);
            break;
        default:
            skip_coordinates(3);
    }
    return Other{};
}

Result<Message> MessageReader::begin_level() {
    protocol_ = {};
    std::int32_t word = cursor_.i32();
    while (word == fte_extensions || word == fte_2_extensions || word == mvd_extensions) {
        const std::uint32_t extensions = cursor_.u32();
        if (word == fte_extensions) {
            protocol_.more_entities = extensions != 0;
            protocol_.wide = protocol_.wide || (extensions & fte_float_coordinates) != 0;
        }
        if (word == mvd_extensions)
            protocol_.wide = protocol_.wide || (extensions & mvd_float_coordinates) != 0;
        word = cursor_.i32();
    }
    if (cursor_.ok() && word != protocol_version)
        return fail(" begins a level with protocol " + std::to_string(word) + ", expected " +
                    std::to_string(protocol_version));
    constexpr std::size_t movement_variables = 10;
    cursor_.take(4);  // how often the server has begun one
    cursor_.text();   // the game's folder
    cursor_.take(4);  // the time
    cursor_.text();   // the level's title
    cursor_.take(movement_variables * 4);
    return BeginLevel{};
}

Result<Message> MessageReader::entities() {
    while (cursor_.ok()) {
        const std::uint16_t bits = cursor_.u16();
        if (bits == 0) break;
        if (auto skipped = entity(bits); !skipped) return tl::unexpected(skipped.error());
    }
    return Other{};
}

Result<void> MessageReader::entity(std::uint16_t bits) {
    enum Bit : std::uint16_t {
        origin_x = 1U << 9U,
        origin_y = 1U << 10U,
        origin_z = 1U << 11U,
        yaw = 1U << 12U,
        frame = 1U << 13U,
        more = 1U << 15U,
    };
    enum MoreBit : std::uint8_t {
        pitch = 1U << 0U,
        roll = 1U << 1U,
        model = 1U << 2U,
        colours = 1U << 3U,
        skin = 1U << 4U,
        effects = 1U << 5U,
        even_more = 1U << 7U,
    };
    enum EvenMoreBit : std::uint16_t {
        translucency = 1U << 1U,
        wide_model = 1U << 3U,
        number_plus_512 = 1U << 5U,
        number_plus_1024 = 1U << 6U,
        yet_more = 1U << 7U,
        tint = 1U << 10U,
    };
    constexpr std::uint16_t known =
        translucency | wide_model | number_plus_512 | number_plus_1024 | yet_more | tint;
    std::uint8_t mores = 0;
    std::uint16_t evens = 0;
    if ((bits & more) != 0) mores = cursor_.u8();
    if ((mores & even_more) != 0 && protocol_.more_entities) evens = cursor_.u8();
    if ((evens & yet_more) != 0) evens = static_cast<std::uint16_t>(evens | (cursor_.u8() << 8U));
    if ((evens & ~known) != 0) return fail(" has an entity with fields of an unknown extension");
    if ((mores & model) != 0)
        cursor_.take(1);
    else if ((evens & wide_model) != 0)
        cursor_.take(2);
    if ((bits & frame) != 0) cursor_.take(1);
    for (const MoreBit bit : {colours, skin, effects})
        if ((mores & bit) != 0) cursor_.take(1);
    skip_coordinates((bits & origin_x) != 0);
    skip_angles((mores & pitch) != 0);
    skip_coordinates((bits & origin_y) != 0);
    skip_angles((bits & yaw) != 0);
    skip_coordinates((bits & origin_z) != 0);
    skip_angles((mores & roll) != 0);
    if ((evens & translucency) != 0) cursor_.take(1);
    if ((evens & tint) != 0) cursor_.take(3);
    return {};
}

float MessageReader::coordinate() {
    const float value = protocol_.wide ? cursor_.f32() : static_cast<float>(cursor_.i16()) / 8.0F;
    if (std::abs(value) <= largest_coordinate) return value;
    invalid_ = true;
    return 0.0F;
}

std::vector<Damage> damage_in(std::span<const std::byte> content) {
    std::vector<Damage> damages;
    Cursor cursor(content);
    while (cursor.left() > 0) {
        const std::uint32_t size = cursor.u32();
        const std::uint16_t type = cursor.u16();
        Cursor section(cursor.take(size));
        if (!cursor.ok()) break;
        if (type != damage_section) continue;
        section.take(2);  // how it was done
        const std::uint16_t attacker = section.u16();
        const auto victim = client_of(section.u16());
        const std::uint16_t amount = section.u16();
        if (section.ok() && victim) damages.push_back({client_of(attacker), *victim, amount});
    }
    return damages;
}

}  // namespace camdir::quakeworld
