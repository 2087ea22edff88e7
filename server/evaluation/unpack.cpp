#include "evaluation/unpack.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>

namespace camdir::evaluation {
namespace {

constexpr std::size_t max_content = std::size_t{1} << 30;
constexpr std::size_t max_expansion = 200;
constexpr std::size_t always_allowed = std::size_t{1} << 20;

bool is_gzip(std::span<const std::byte> bytes) {
    return bytes.size() >= 2 && bytes[0] == std::byte{0x1f} && bytes[1] == std::byte{0x8b};
}

}  // namespace

class Unpacker::Inflater {
  public:
    explicit Inflater(std::span<const std::byte> bytes)
        : left_(bytes), limit_(std::min(max_content, always_allowed + max_expansion * bytes.size())) {
        constexpr int gzip_window = 15 + 16;
        ready_ = inflateInit2(&stream_, gzip_window) == Z_OK;
    }
    Inflater(const Inflater&) = delete;
    Inflater& operator=(const Inflater&) = delete;
    ~Inflater() { inflateEnd(&stream_); }

    Result<std::span<const std::byte>> next() {
        if (!ready_) return fail("out of memory to decompress");
        while (!ended_) {
            const auto piece = step();
            if (!piece || !piece->empty()) return piece;
        }
        return std::span<const std::byte>{};
    }

  private:
    Result<std::span<const std::byte>> step() {
        feed();
        stream_.next_out = buffer_.data();
        stream_.avail_out = static_cast<uInt>(buffer_.size());
        const int status = inflate(&stream_, Z_NO_FLUSH);
        const std::size_t size = buffer_.size() - stream_.avail_out;
        produced_ += size;
        if (produced_ > limit_)
            return fail("decompresses to more than " + std::to_string(limit_) +
                        " bytes, which is the limit for a file of this size");
        if (status == Z_STREAM_END) {
            ended_ = exhausted();
            if (!ended_ && inflateReset(&stream_) != Z_OK) return fail("cannot restart decompression");
        } else if (status == Z_BUF_ERROR && exhausted()) {
            return fail("compressed data end too early");
        } else if (status != Z_OK) {
            return fail(std::string("compressed data are damaged: ") +
                        (stream_.msg != nullptr ? stream_.msg : "unexpected end"));
        }
        return std::as_bytes(std::span(buffer_).first(size));
    }

    void feed() {
        if (stream_.avail_in != 0) return;
        const std::size_t size =
            std::min<std::size_t>(left_.size(), std::numeric_limits<std::int32_t>::max());
        // zlib's interface is not const-correct; it does not write to its input.
        stream_.next_in = reinterpret_cast<Bytef*>(const_cast<std::byte*>(left_.data()));
        stream_.avail_in = static_cast<uInt>(size);
        left_ = left_.subspan(size);
    }

    [[nodiscard]] bool exhausted() const { return stream_.avail_in == 0 && left_.empty(); }

    z_stream stream_{};
    std::span<const std::byte> left_;
    std::size_t limit_;
    std::size_t produced_ = 0;
    bool ready_ = false;
    bool ended_ = false;
    std::array<Bytef, 65536> buffer_{};
};

Unpacker::Unpacker(std::span<const std::byte> bytes) {
    if (is_gzip(bytes))
        inflater_ = std::make_unique<Inflater>(bytes);
    else
        plain_ = bytes;
}

Unpacker::~Unpacker() = default;

Result<std::span<const std::byte>> Unpacker::next() {
    return inflater_ ? inflater_->next() : std::exchange(plain_, {});
}

}  // namespace camdir::evaluation
