#include "evaluation/quakeworld/mvd.hpp"

#include "evaluation/quakeworld/demo.hpp"
#include "evaluation/quakeworld/match_events.hpp"
#include "evaluation/quakeworld/tracks.hpp"
#include "evaluation/unpack.hpp"

namespace camdir::evaluation::quakeworld {
namespace {

std::string warning_of(const Demo& demo) {
    std::string warning;
    if (demo.unread_blocks > 0)
        warning = std::to_string(demo.unread_blocks) + " of " + std::to_string(demo.blocks) +
                  " blocks are read only in part; " + demo.first_unread;
    if (demo.cut_off.empty()) return warning;
    return (warning.empty() ? "" : warning + "; ") + "is cut off; " + demo.cut_off;
}

}  // namespace

// A demo begins with the milliseconds to its first block, a text with a letter, a sign or an end of line.
bool is_demo(std::span<const std::byte> content) {
    return !content.empty() && content[0] < std::byte{' '} && content[0] != std::byte{'\t'} &&
           content[0] != std::byte{'\n'} && content[0] != std::byte{'\r'};
}

Result<RecordedMatch> parse_demo(std::span<const std::byte> bytes, const std::string& name) {
    Unpacker content(bytes);
    const auto demo = read_demo(content);
    if (!demo) return fail(name + ": " + demo.error().message);
    RecordedMatch match{trace_of(*demo), {}, {}};
    match.events = events_of(*demo, match.trace);
    if (const std::string warning = warning_of(*demo); !warning.empty())
        match.warning = name + ": " + warning;
    return match;
}

}  // namespace camdir::evaluation::quakeworld
