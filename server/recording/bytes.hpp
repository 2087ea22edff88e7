// Little-endian fields and varints (LEB128), for the content of resources.
#pragma once

#include <bit>
#include <cstdint>
#include <limits>
#include <span>
#include <string>

#include "base/file.hpp"

namespace camdir::recording {

class ByteSink {
  public:
    void fixed(std::uint64_t value, int size) {
        for (int i = 0; i < size; ++i)
            bytes.push_back(static_cast<std::byte>(value >> (8 * i)));
    }
    void varint(std::uint64_t value) {
        for (; value >= 0x80; value >>= 7)
            fixed((value & 0x7f) | 0x80, 1);
        fixed(value, 1);
    }
    void difference(std::int64_t value) {
        varint((static_cast<std::uint64_t>(value) << 1) ^ static_cast<std::uint64_t>(value >> 63));
    }
    void text(const std::string& value) {
        varint(value.size());
        append(std::as_bytes(std::span(value)));
    }
    void append(std::span<const std::byte> more) { bytes.insert(bytes.end(), more.begin(), more.end()); }

    Bytes bytes;
};

// Reads what ByteSink wrote. After a read past the end everything is 0 and ok() is false.
class ByteSource {
  public:
    explicit ByteSource(std::span<const std::byte> bytes) : bytes_(bytes) {}

    [[nodiscard]] bool ok() const { return ok_; }
    [[nodiscard]] std::size_t left() const { return bytes_.size() - at_; }
    [[nodiscard]] std::size_t offset() const { return at_; }

    std::uint64_t fixed(int size) {
        std::uint64_t value = 0;
        const auto field = take(static_cast<std::size_t>(size));
        for (std::size_t i = 0; i < field.size(); ++i)
            value |= static_cast<std::uint64_t>(field[i]) << (8 * i);
        return value;
    }
    // A value beyond 64 bits is no varint.
    std::uint64_t varint() {
        std::uint64_t value = 0;
        for (int shift = 0; shift < 64; shift += 7) {
            const std::uint64_t byte = fixed(1);
            if (shift == 63 && byte > 1) break;
            value |= (byte & 0x7f) << shift;
            if (byte < 0x80) return value;
        }
        ok_ = false;
        return 0;
    }
    // A varint of at most 32 bits.
    std::uint32_t number() {
        const std::uint64_t value = varint();
        if (value <= std::numeric_limits<std::uint32_t>::max()) return static_cast<std::uint32_t>(value);
        ok_ = false;
        return 0;
    }
    std::int64_t difference() {
        const std::uint64_t value = varint();
        return static_cast<std::int64_t>((value >> 1) ^ (0 - (value & 1)));
    }
    std::string text() {
        const auto field = take(varint());
        return {reinterpret_cast<const char*>(field.data()), field.size()};
    }
    // How many elements follow, each of at least `size` bytes: at most `max`.
    std::size_t count(std::size_t size, std::size_t max) {
        const std::uint64_t value = varint();
        if (value <= max && value <= left() / size) return static_cast<std::size_t>(value);
        ok_ = false;
        return 0;
    }
    std::span<const std::byte> take(std::uint64_t size) {
        if (!ok_ || size > left()) {
            ok_ = false;
            return {};
        }
        const auto field = bytes_.subspan(at_, static_cast<std::size_t>(size));
        at_ += field.size();
        return field;
    }

  private:
    std::span<const std::byte> bytes_;
    std::size_t at_ = 0;
    bool ok_ = true;
};

}  // namespace camdir::recording
