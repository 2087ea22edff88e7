// Recorded matches: every player's pose in every frame of a game server. Read by `evaluate` and replayed by
// the load generators.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/geometry.hpp"
#include "base/view_angles.hpp"

namespace camdir::evaluation {

// One player in one frame, in the project's units and axes (quaternion: x forward, y left, z up).
struct TracePose {
    std::uint32_t player = 0;
    Vec3d eye = Vec3d::Zero();
    Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
    Vec3d velocity = Vec3d::Zero();  // map units a second
    float view_height = 0.0F;        // of the eye over the player's origin
    std::uint8_t team = 0;
    bool alive = true;
    bool discontinuity = false;  // respawned, teleported, or first seen since the frame before

    [[nodiscard]] Vec3d origin() const { return eye - Vec3d(0.0, 0.0, view_height); }
};

struct TraceFrame {
    std::int64_t time = 0;         // ns, the game's clock
    std::uint32_t first_pose = 0;  // its poses are poses[first_pose .. first_pose + pose_count)
    std::uint32_t pose_count = 0;  // at most 256, at least 1
};

// Times ascend strictly; a frame's poses ascend strictly by player. A player may be missing from a frame.
struct Trace {
    std::vector<std::uint32_t> players;  // every player of any frame, ascending; at most 256
    std::vector<TraceFrame> frames;
    std::vector<TracePose> poses;

    [[nodiscard]] std::span<const TracePose> poses_of(const TraceFrame& frame) const {
        return std::span(poses).subspan(frame.first_pose, frame.pose_count);
    }
};

// A player's pose in a frame of the trace: the index into Trace::poses, or `absent`.
inline constexpr std::uint32_t absent = 0xffffffffU;
[[nodiscard]] std::uint32_t pose_of(const Trace& trace, const TraceFrame& frame, std::uint32_t player);

// The same for every frame.
[[nodiscard]] std::vector<std::uint32_t> track_of(const Trace& trace, std::uint32_t player);

// Reads a trace in Quake units and axes, CSV or CSV.gz, with at least the columns t_ms, player, x, y, z,
// pitch, yaw, roll, vx, vy, vz, viewheight, team, teleport_bit, alive in any order: degrees, positive pitch
// looks down, eye = (x, y, z + viewheight), teleport_bit toggles at every respawn and teleport. Rows are
// ordered by t_ms. Errors name the file (`name`), the line, the column and what was expected. Memory: at most
// five times the text's size; read_csv states how far compressed text may expand. Thread-safe.
[[nodiscard]] Result<Trace> parse_trace(std::span<const std::byte> bytes, const std::string& name);

// The trace of a recorded match in any of the formats of read_match().
[[nodiscard]] Result<Trace> read_trace(const std::filesystem::path& path);

}  // namespace camdir::evaluation
