// What a multi-view demo says about its match.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "evaluation/unpack.hpp"
#include "quakeworld/frames.hpp"

namespace camdir::evaluation::quakeworld {

using camdir::quakeworld::Frame;
using camdir::quakeworld::max_slots;
using camdir::quakeworld::Occurrence;
using camdir::quakeworld::Pose;
using camdir::quakeworld::Slot;

struct DemoFrame {
    std::int64_t time = 0;          // ms since the demo's begin
    std::uint32_t first_pose = 0;   // poses[first_pose .. first_pose + pose_count), ascending by slot
    std::uint32_t pose_count = 0;   // at least 1
    std::uint32_t first_flash = 0;  // flashes[first_flash .. first_flash + flash_count)
    std::uint32_t flash_count = 0;
};

// From the begin of the demo's first match to its end; where the server announces none, all of the demo.
struct Demo {
    std::vector<DemoFrame> frames;  // times ascend strictly
    std::vector<Pose> poses;
    std::vector<Vec3d> flashes;           // where players teleported from and to
    std::vector<Occurrence> occurrences;  // of obituaries, damage and items; times do not descend
    std::array<std::string, max_slots> teams;
    bool teamplay = false;

    std::size_t blocks = 0;
    std::size_t unread_blocks = 0;  // of which some messages, from one on, could not be read
    std::string first_unread;       // where and why
    std::string cut_off;            // where, if it ends within a block
};

// Errors name the byte and what was expected. Memory: at most 40 times the demo's size.
[[nodiscard]] Result<Demo> read_demo(Unpacker& content);

}  // namespace camdir::evaluation::quakeworld
