#include "evaluation/lines.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <string>

namespace camdir::evaluation {
namespace {

constexpr std::size_t max_line = 4096;
constexpr std::size_t max_text = std::size_t{1} << 30;
constexpr std::size_t max_expansion = 200;
constexpr std::size_t always_allowed = std::size_t{1} << 20;

bool is_gzip(std::span<const std::byte> bytes) {
    return bytes.size() >= 2 && bytes[0] == std::byte{0x1f} && bytes[1] == std::byte{0x8b};
}

// Cuts a stream of pieces of text into lines.
class Splitter {
  public:
    explicit Splitter(const LineSink& sink) : sink_(sink) {}

    Result<void> add(std::string_view text) {
        while (!text.empty()) {
            const std::size_t end = text.find('\n');
            const std::string_view piece = text.substr(0, end);
            if (pending_.size() + piece.size() > max_line)
                return fail("line is longer than " + std::to_string(max_line) + " bytes");
            pending_ += piece;
            if (end == std::string_view::npos) return {};
            if (auto taken = flush(); !taken) return taken;
            text.remove_prefix(end + 1);
        }
        return {};
    }

    Result<void> finish() { return pending_.empty() ? Result<void>{} : flush(); }

  private:
    Result<void> flush() {
        std::string_view line = pending_;
        if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
        auto taken = sink_(line);
        pending_.clear();
        return taken;
    }

    const LineSink& sink_;
    std::string pending_;
};

class Inflater {
  public:
    explicit Inflater(std::span<const std::byte> bytes)
        : left_(bytes), limit_(std::min(max_text, always_allowed + max_expansion * bytes.size())) {}
    Inflater(const Inflater&) = delete;
    Inflater& operator=(const Inflater&) = delete;
    ~Inflater() { inflateEnd(&stream_); }

    Result<void> run(Splitter& lines) {
        constexpr int gzip_window = 15 + 16;
        if (inflateInit2(&stream_, gzip_window) != Z_OK) return fail("out of memory to decompress");
        while (true) {
            feed();
            stream_.next_out = buffer_.data();
            stream_.avail_out = static_cast<uInt>(buffer_.size());
            const int status = inflate(&stream_, Z_NO_FLUSH);
            if (auto kept = pass_on(lines); !kept) return kept;
            if (status == Z_STREAM_END) {
                if (exhausted()) return {};
                if (inflateReset(&stream_) != Z_OK) return fail("cannot restart decompression");
            } else if (status == Z_BUF_ERROR && exhausted()) {
                return fail("compressed data end too early");
            } else if (status != Z_OK) {
                return fail(std::string("compressed data are damaged: ") +
                            (stream_.msg != nullptr ? stream_.msg : "unexpected end"));
            }
        }
    }

  private:
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

    Result<void> pass_on(Splitter& lines) {
        const std::size_t size = buffer_.size() - stream_.avail_out;
        produced_ += size;
        if (produced_ > limit_)
            return fail("decompresses to more than " + std::to_string(limit_) +
                        " bytes, which is the limit for a file of this size");
        return lines.add({reinterpret_cast<const char*>(buffer_.data()), size});
    }

    z_stream stream_{};
    std::span<const std::byte> left_;
    std::size_t limit_;
    std::size_t produced_ = 0;
    std::array<Bytef, 65536> buffer_{};
};

}  // namespace

Result<void> for_each_line(std::span<const std::byte> bytes, const LineSink& sink) {
    Splitter lines(sink);
    const Result<void> read = is_gzip(bytes)
                                  ? Inflater(bytes).run(lines)
                                  : lines.add({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    return read ? lines.finish() : read;
}

}  // namespace camdir::evaluation
