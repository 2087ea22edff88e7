// Recorded cameras of a trace: one camera for every player and frame.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "evaluation/trace.hpp"

namespace camdir::evaluation {

struct CameraSample {
    Vec3d position = Vec3d::Zero();
    Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  // x forward, y left, z up
    bool cut = false;  // a declared jump: not continuous with the sample before
    // The camera does not call its target hidden. In no table: cameras that are read claim it always.
    bool claims_sight = true;
};

// cameras[i] follows the player of trace.poses[i], at that frame's time.
using CameraPath = std::vector<CameraSample>;

// CSV with the header t_ms,player,x,y,z,qw,qx,qy,qz,cut and a row for each pose of the trace, in its order;
// positions with 5 decimals, quaternions with 9. Precondition: one camera a pose.
[[nodiscard]] std::string format_cameras(const Trace& trace, std::span<const CameraSample> cameras);

// Reads such a table (CSV or CSV.gz, columns by name, rows ordered by t_ms) that was made for `trace`. Fails
// when a pose of the trace has no row or a row has no pose, and when a quaternion's length differs from 1 by
// more than 1e-3; errors name the file and the line.
[[nodiscard]] Result<CameraPath> read_cameras(const std::filesystem::path& path, const Trace& trace);
[[nodiscard]] Result<CameraPath> parse_cameras(std::span<const std::byte> bytes, const std::string& name,
                                               const Trace& trace);

// t_ms as the tables write it: milliseconds, with as many of 6 decimals as the time needs.
[[nodiscard]] std::string format_milliseconds(std::int64_t nanoseconds);

}  // namespace camdir::evaluation
