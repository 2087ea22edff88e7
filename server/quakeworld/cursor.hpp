// Reads the fields of a message.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace camdir::quakeworld {

// Little-endian fields. After a read past the end everything is 0 and ok() is false.
class Cursor {
  public:
    explicit Cursor(std::span<const std::byte> bytes) : bytes_(bytes) {}

    [[nodiscard]] bool ok() const { return ok_; }
    [[nodiscard]] std::size_t offset() const { return at_; }
    [[nodiscard]] std::size_t left() const { return bytes_.size() - at_; }

    std::uint8_t u8() { return static_cast<std::uint8_t>(fixed(1)); }
    std::uint16_t u16() { return static_cast<std::uint16_t>(fixed(2)); }
    std::int16_t i16() { return static_cast<std::int16_t>(u16()); }
    std::uint32_t u32() { return fixed(4); }
    std::int32_t i32() { return static_cast<std::int32_t>(u32()); }
    float f32() { return std::bit_cast<float>(u32()); }
    // Up to a zero byte, without it.
    std::string_view text() {
        const auto rest = bytes_.subspan(at_);
        const std::string_view all(reinterpret_cast<const char*>(rest.data()), rest.size());
        const std::size_t end = all.find('\0');
        if (end == std::string_view::npos) {
            take(rest.size() + 1);
            return {};
        }
        take(end + 1);
        return all.substr(0, end);
    }
    std::span<const std::byte> take(std::size_t size) {
        if (!ok_ || size > left()) {
            ok_ = false;
            at_ = bytes_.size();
            return {};
        }
        at_ += size;
        return bytes_.subspan(at_ - size, size);
    }

  private:
    std::uint32_t fixed(std::size_t size) {
        std::uint32_t value = 0;
        const auto field = take(size);
        for (std::size_t i = 0; i < field.size(); ++i)
            value |= static_cast<std::uint32_t>(field[i]) << (8 * i);
        return value;
    }

    std::span<const std::byte> bytes_;
    std::size_t at_ = 0;
    bool ok_ = true;
};

}  // namespace camdir::quakeworld
