#include "evaluation/quakeworld/demo.hpp"

#include <algorithm>
#include <utility>

namespace camdir::evaluation::quakeworld {
namespace {

using camdir::quakeworld::BlockReader;
using camdir::quakeworld::FrameReader;

constexpr std::size_t piece_size = 1U << 16U;  // bytes

class Recorder {
  public:
    void add(const Frame& frame, const FrameReader& reader) {
        if (over_) return;
        for (const Occurrence& occurrence : frame.occurrences)
            add(occurrence);
        if (!over_ && !frame.poses.empty()) add_poses(frame, reader);
    }

    [[nodiscard]] Demo take() { return std::move(demo_); }

  private:
    void add(const Occurrence& occurrence) {
        if (over_) return;
        switch (occurrence.kind) {
            case Occurrence::Kind::match_begin:
                demo_.frames.clear();
                demo_.poses.clear();
                demo_.flashes.clear();
                demo_.occurrences.clear();
                break;
            case Occurrence::Kind::match_end:
                over_ = true;
                break;
            default:
                demo_.occurrences.push_back(occurrence);
        }
    }

    void add_poses(const Frame& frame, const FrameReader& reader) {
        demo_.frames.push_back({frame.time, static_cast<std::uint32_t>(demo_.poses.size()),
                                static_cast<std::uint32_t>(frame.poses.size()),
                                static_cast<std::uint32_t>(demo_.flashes.size()),
                                static_cast<std::uint32_t>(frame.flashes.size())});
        demo_.poses.insert(demo_.poses.end(), frame.poses.begin(), frame.poses.end());
        demo_.flashes.insert(demo_.flashes.end(), frame.flashes.begin(), frame.flashes.end());
        for (const Pose& pose : frame.poses)
            demo_.teams[pose.slot] = reader.clients()[pose.slot].team;
        demo_.teamplay = reader.teamplay();
    }

    Demo demo_;
    bool over_ = false;
};

// Reads the blocks that are complete, until the match is over.
Result<void> read_blocks(BlockReader& blocks, FrameReader& frames, Recorder& recorder) {
    while (!frames.match_is_over()) {
        const auto block = blocks.next();
        if (!block) return tl::unexpected(block.error());
        if (!*block) return {};
        if (const auto frame = frames.read(**block)) recorder.add(*frame, frames);
    }
    return {};
}

Result<void> read_content(Unpacker& content, BlockReader& blocks, FrameReader& frames, Recorder& recorder) {
    while (true) {
        auto piece = content.next();
        if (!piece) return tl::unexpected(piece.error());
        if (piece->empty()) return {};
        while (!piece->empty()) {
            const std::size_t size = std::min(piece->size(), piece_size);
            blocks.append(piece->first(size));
            *piece = piece->subspan(size);
            if (const auto read = read_blocks(blocks, frames, recorder); !read) return read;
            if (frames.match_is_over()) return {};
        }
    }
}

}  // namespace

Result<Demo> read_demo(Unpacker& content) {
    BlockReader blocks;
    FrameReader frames;
    Recorder recorder;
    if (const auto read = read_content(content, blocks, frames, recorder); !read)
        return tl::unexpected(read.error());
    if (const auto frame = frames.finish()) recorder.add(*frame, frames);
    if (const auto readable = frames.expect_readable(); !readable) return tl::unexpected(readable.error());
    Demo demo = recorder.take();
    // A crash of who recorded it cuts a demo off; what follows the match's end does not matter.
    const auto ended = frames.match_is_over() ? Result<void>() : blocks.expect_end();
    if (demo.frames.empty())
        return fail(ended ? "no player in it, expected at least one frame with a player"
                          : ended.error().message);
    if (!ended) demo.cut_off = ended.error().message;
    demo.blocks = frames.blocks();
    demo.unread_blocks = frames.unread_blocks();
    demo.first_unread = frames.first_unread();
    return demo;
}

}  // namespace camdir::evaluation::quakeworld
