#include "evaluation/match.hpp"

#include "base/file.hpp"
#include "evaluation/quakeworld/mvd.hpp"
#include "evaluation/unpack.hpp"

namespace camdir::evaluation {

Result<RecordedMatch> parse_match(std::span<const std::byte> bytes, const std::string& name) {
    Unpacker content(bytes);
    const auto begin = content.next();
    if (begin && quakeworld::is_demo(*begin)) return quakeworld::parse_demo(bytes, name);
    auto trace = parse_trace(bytes, name);
    if (!trace) return tl::unexpected(trace.error());
    return RecordedMatch{std::move(*trace), {}, {}};
}

Result<RecordedMatch> read_match(const std::filesystem::path& path) {
    const auto bytes = read_file(path);
    if (!bytes) return tl::unexpected(bytes.error());
    return parse_match(*bytes, path.string());
}

}  // namespace camdir::evaluation
