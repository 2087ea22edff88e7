// What a multi-view demo says about its match.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/geometry.hpp"
#include "evaluation/quakeworld/blocks.hpp"

namespace camdir::evaluation::quakeworld {

using Slot = std::uint8_t;  // of a client at the server, below max_slots

struct DemoPose {
    Slot slot = 0;
    Vec3d origin = Vec3d::Zero();
    Vec3d angles = Vec3d::Zero();  // pitch, yaw, roll; degrees
    bool alive = true;             // and has a body: players who wait for the next round have none
    bool gibbed = false;
};

struct DemoFrame {
    std::int64_t time = 0;          // ms since the demo's begin
    std::uint32_t first_pose = 0;   // poses[first_pose .. first_pose + pose_count), ascending by slot
    std::uint32_t pose_count = 0;   // at least 1
    std::uint32_t first_flash = 0;  // flashes[first_flash .. first_flash + flash_count)
    std::uint32_t flash_count = 0;
};

struct Occurrence {
    enum class Kind { obituary, damage, item };

    std::int64_t time = 0;  // ms since the demo's begin
    Kind kind = Kind::obituary;
    std::optional<Slot> actor;    // of an obituary: the killer; who did the damage or took the item
    std::optional<Slot> subject;  // the victim
    std::string detail;           // Obituary::cause, hit points, the item's name
};

// From the begin of the demo's first match to its end; where the server announces none, all of the demo.
struct Demo {
    std::vector<DemoFrame> frames;  // times ascend strictly
    std::vector<DemoPose> poses;
    std::vector<Vec3d> flashes;           // where players teleported from and to
    std::vector<Occurrence> occurrences;  // times do not descend
    std::array<std::string, max_slots> teams;
    bool teamplay = false;

    std::size_t blocks = 0;
    std::size_t unread_blocks = 0;  // of which some messages, from one on, could not be read
    std::string first_unread;       // where and why
};

// Errors name the byte and what was expected. Memory: at most 40 times the demo's size.
[[nodiscard]] Result<Demo> read_demo(std::span<const std::byte> bytes);

}  // namespace camdir::evaluation::quakeworld
