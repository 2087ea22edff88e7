#include "evaluation/lines.hpp"

#include <string>

#include "evaluation/unpack.hpp"

namespace camdir::evaluation {
namespace {

constexpr std::size_t max_line = 4096;

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

}  // namespace

Result<void> for_each_line(std::span<const std::byte> bytes, const LineSink& sink) {
    Unpacker unpacker(bytes);
    Splitter lines(sink);
    while (true) {
        const auto piece = unpacker.next();
        if (!piece) return tl::unexpected(piece.error());
        if (piece->empty()) return lines.finish();
        if (auto added = lines.add({reinterpret_cast<const char*>(piece->data()), piece->size()}); !added)
            return added;
    }
}

}  // namespace camdir::evaluation
