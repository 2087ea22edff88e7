// A server's messages, as far as the record of a match needs them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <variant>
#include <vector>

#include "base/error.hpp"
#include "base/geometry.hpp"
#include "quakeworld/blocks.hpp"
#include "quakeworld/cursor.hpp"

namespace camdir::quakeworld {

// What the server and the demo agreed on when the level began.
struct Protocol {
    bool wide = false;           // coordinates are floats and angles 16 bits; else coordinates are eighths
    bool more_entities = false;  // entities may have FTE's further fields
};

// Texts are views of the block, as they are written.

// What changed of a player since the last one; flags are of now.
struct PlayerInfo {
    std::uint8_t slot = 0;
    std::array<std::optional<float>, 3> origin;  // map units, finite
    std::array<std::optional<float>, 3> angles;  // pitch, yaw, roll; degrees
    std::optional<std::uint8_t> model;           // 0: none
    bool dead = false;
    bool gibbed = false;
};
struct Stat {  // of the block's player
    std::uint8_t number = 0;
    std::int32_t value = 0;
};
struct Print {
    std::uint8_t level = 0;  // 1: obituaries, 2: what everyone should read
    std::string_view text;
};
struct ClientCommand {
    std::string_view text;
};
struct UserInfo {
    std::uint8_t slot = 0;
    std::string_view info;  // \key\value...
};
struct UserKey {
    std::uint8_t slot = 0;
    std::string_view key;
    std::string_view value;
};
struct ServerKey {
    std::string_view key;
    std::string_view value;
};
struct BeginLevel {};  // what was said of the level before is over
struct Models {
    std::size_t first = 0;  // number of the first one; the map is number 1
    std::vector<std::string_view> names;
};
struct TeleportFlash {
    Vec3d position = Vec3d::Zero();  // finite
};
struct Intermission {};
struct Other {};  // every other message

using Message = std::variant<Other, PlayerInfo, Stat, Print, ClientCommand, UserInfo, UserKey, ServerKey,
                             BeginLevel, Models, TeleportFlash, Intermission>;

// Hands out the messages of a block for clients.
class MessageReader {
  public:
    // `protocol` is read, and written by the message that begins a level.
    MessageReader(std::span<const std::byte> content, Protocol& protocol)
        : cursor_(content), protocol_(protocol) {}

    [[nodiscard]] bool at_end() const { return cursor_.left() == 0; }

    // Precondition: not at the end. An error, which names the byte of the block, is an unknown message or one
    // that ends early: where the next one begins is unknown then, and it must not be called again.
    [[nodiscard]] Result<Message> next();

    // Whether the last message, read or not, begins a level.
    [[nodiscard]] bool begins_level() const { return begins_level_; }

  private:
    [[nodiscard]] Result<Message> read(std::uint8_t number);
    [[nodiscard]] Result<Message> read_fixed(std::uint8_t number);
    Message player_info();
    Message models(bool wide_number);
    Message temporary_entity();
    [[nodiscard]] Result<Message> begin_level();
    [[nodiscard]] Result<Message> entities();
    [[nodiscard]] Result<void> entity(std::uint16_t bits);
    [[nodiscard]] float coordinate();
    void skip_coordinates(std::size_t count) { cursor_.take(count * (protocol_.wide ? 4 : 2)); }
    void skip_angles(std::size_t count) { cursor_.take(count * (protocol_.wide ? 2 : 1)); }

    Cursor cursor_;
    Protocol& protocol_;
    bool invalid_ = false;  // a value of the message was not
    bool begins_level_ = false;
};

// Hit points that one client or the world took of another, out of a block that is hidden from clients.
struct Damage {
    std::optional<std::uint8_t> attacker;  // slot; nothing: the world
    std::uint8_t victim = 0;
    std::uint16_t amount = 0;
};

// Other sections of the block, and damage to what is no client, are skipped; one that is cut off ends it.
[[nodiscard]] std::vector<Damage> damage_in(std::span<const std::byte> content);

}  // namespace camdir::quakeworld
