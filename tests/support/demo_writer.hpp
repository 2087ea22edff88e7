// Writes multi-view demos of QuakeWorld, message by message.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>

#include "base/file.hpp"
#include "base/geometry.hpp"

namespace camdir::test {

// The content of a block: messages, or sections that are hidden from clients. Fields are little-endian.
class DemoMessages {
  public:
    explicit DemoMessages(bool wide = false) : wide_(wide) {}

    DemoMessages& number(std::uint64_t value, int size) {
        for (int i = 0; i < size; ++i)
            bytes_.push_back(static_cast<std::byte>(value >> (8 * i)));
        return *this;
    }
    DemoMessages& real(float value) { return number(std::bit_cast<std::uint32_t>(value), 4); }
    DemoMessages& zeros(int count) {
        for (int i = 0; i < count; ++i)
            number(0, 1);
        return *this;
    }
    DemoMessages& text(std::string_view value) {
        for (const char sign : value)
            bytes_.push_back(static_cast<std::byte>(sign));
        return number(0, 1);
    }
    DemoMessages& coordinate(double value) {
        return wide_ ? real(static_cast<float>(value))
                     : number(static_cast<std::uint64_t>(std::llround(value * 8.0)), 2);
    }
    DemoMessages& coordinates(const Vec3d& value) {
        return coordinate(value.x()).coordinate(value.y()).coordinate(value.z());
    }

    // With all that such a message may have.
    struct Pose {
        Vec3d origin = Vec3d::Zero();
        Vec3d angles = Vec3d::Zero();  // multiples of 360 / 65536 degrees
        int model = 1;
        bool dead = false;
        bool gibbed = false;
    };
    DemoMessages& player(int slot, const Pose& pose) {
        const unsigned flags = 0xcffU | (pose.dead ? 0x100U : 0U) | (pose.gibbed ? 0x200U : 0U);
        number(42, 1).number(static_cast<std::uint64_t>(slot), 1).number(flags, 2).number(7, 1);
        coordinates(pose.origin);
        for (int axis = 0; axis < 3; ++axis)
            number(static_cast<std::uint64_t>(std::llround(pose.angles[axis] * 65536.0 / 360.0)), 2);
        return number(static_cast<std::uint64_t>(pose.model), 1).zeros(3);
    }
    // One axis of the origin, nothing else.
    DemoMessages& player_moved(int slot, int axis, double to) {
        return number(42, 1)
            .number(static_cast<std::uint64_t>(slot), 1)
            .number(1U << axis, 2)
            .zeros(1)
            .coordinate(to);
    }
    DemoMessages& stat(int which, std::uint8_t value) {
        return number(3, 1).number(static_cast<std::uint64_t>(which), 1).number(value, 1);
    }
    DemoMessages& long_stat(int which, std::int32_t value) {
        return number(38, 1)
            .number(static_cast<std::uint64_t>(which), 1)
            .number(static_cast<std::uint32_t>(value), 4);
    }
    DemoMessages& print(int level, std::string_view line) {
        return number(8, 1).number(static_cast<std::uint64_t>(level), 1).text(line);
    }
    DemoMessages& client_command(std::string_view command) { return number(9, 1).text(command); }
    DemoMessages& user_info(int slot, std::string_view info) {
        return number(40, 1).number(static_cast<std::uint64_t>(slot), 1).zeros(4).text(info);
    }
    DemoMessages& user_key(int slot, std::string_view key, std::string_view value) {
        return number(51, 1).number(static_cast<std::uint64_t>(slot), 1).text(key).text(value);
    }
    DemoMessages& server_key(std::string_view key, std::string_view value) {
        return number(52, 1).text(key).text(value);
    }
    DemoMessages& models(std::initializer_list<std::string_view> names) {
        number(45, 1).zeros(1);
        for (const std::string_view name : names)
            text(name);
        return zeros(2);
    }
    DemoMessages& teleport_flash(const Vec3d& position) {
        return number(23, 1).number(11, 1).coordinates(position);
    }
    DemoMessages& intermission() { return number(30, 1).coordinates(Vec3d::Zero()).zeros(wide_ ? 6 : 3); }
    // extensions: pairs of a magic number and its bits.
    DemoMessages& begin_level(std::initializer_list<std::pair<std::uint32_t, std::uint32_t>> extensions = {},
                              std::uint32_t protocol = 28) {
        number(11, 1);
        for (const auto& [magic, bits] : extensions)
            number(magic, 4).number(bits, 4);
        return number(protocol, 4).number(5, 4).text("qw").real(1.0F).text("A level").zeros(40);
    }
    DemoMessages& hidden_section(std::uint16_t type, const DemoMessages& content) {
        number(content.bytes_.size(), 4).number(type, 2);
        bytes_.insert(bytes_.end(), content.bytes_.begin(), content.bytes_.end());
        return *this;
    }
    // Entities: slots and 1; 0 is the world.
    DemoMessages& hidden_damage(int attacker, int victim, int amount) {
        return hidden_section(7, DemoMessages()
                                     .number(1, 2)
                                     .number(static_cast<std::uint64_t>(attacker), 2)
                                     .number(static_cast<std::uint64_t>(victim), 2)
                                     .number(static_cast<std::uint64_t>(amount), 2));
    }

    [[nodiscard]] const Bytes& bytes() const { return bytes_; }

  private:
    bool wide_;
    Bytes bytes_;
};

inline constexpr std::uint32_t fte = 0x58455446;
inline constexpr std::uint32_t fte_2 = 0x32455446;
inline constexpr std::uint32_t mvd_1 = 0x3144564d;

// Puts blocks behind each other; `after` is the time since the last one, ms.
class DemoWriter {
  public:
    DemoWriter& to_everyone(int after, const DemoMessages& content) { return block(after, 6, content); }
    DemoWriter& to_reader(int after, const DemoMessages& content) { return block(after, 1, content); }
    DemoWriter& to_one(int after, int slot, const DemoMessages& content) {
        return block(after, 4 | (slot << 3), content);
    }
    DemoWriter& stats(int after, int slot, const DemoMessages& content) {
        return block(after, 5 | (slot << 3), content);
    }
    DemoWriter& to_some(int after, std::uint32_t mask, const DemoMessages& content) {
        header(after, 3);
        number(mask, 4);
        return sized(content);
    }
    DemoWriter& hidden(int after, const DemoMessages& content) { return to_some(after, 0, content); }
    DemoWriter& sequences(int after) {
        header(after, 2);
        number(0, 8);
        return *this;
    }
    DemoWriter& header(int after, int command) {
        number(static_cast<std::uint64_t>(after), 1);
        number(static_cast<std::uint64_t>(command), 1);
        return *this;
    }
    DemoWriter& number(std::uint64_t value, int size) {
        const DemoMessages field = DemoMessages().number(value, size);
        bytes_.insert(bytes_.end(), field.bytes().begin(), field.bytes().end());
        return *this;
    }

    [[nodiscard]] const Bytes& bytes() const { return bytes_; }

  private:
    DemoWriter& block(int after, int command, const DemoMessages& content) {
        return header(after, command).sized(content);
    }
    DemoWriter& sized(const DemoMessages& content) {
        number(content.bytes().size(), 4);
        bytes_.insert(bytes_.end(), content.bytes().begin(), content.bytes().end());
        return *this;
    }

    Bytes bytes_;
};

}  // namespace camdir::test
