#include "evaluation/camera_path.hpp"

#include <array>
#include <cassert>
#include <charconv>
#include <cmath>

#include "base/file.hpp"
#include "evaluation/csv.hpp"

namespace camdir::evaluation {
namespace {

enum Field { t_ms, player, x, y, z, qw, qx, qy, qz, cut, field_count };

constexpr Column columns[] = {
    {"t_ms", 0.0, 1e12},
    {"player", 0.0, 4294967294.0, true},
    {"x", -largest_coordinate, largest_coordinate},
    {"y", -largest_coordinate, largest_coordinate},
    {"z", -largest_coordinate, largest_coordinate},
    {"qw", -1.001, 1.001},
    {"qx", -1.001, 1.001},
    {"qy", -1.001, 1.001},
    {"qz", -1.001, 1.001},
    {"cut", 0.0, 1.0, true},
};
static_assert(std::size(columns) == field_count);

void append(std::string& text, double value, int decimals) {
    std::array<char, 64> digits{};
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value,
                                   std::chars_format::fixed, decimals);
    assert(end.ec == std::errc{});
    text += ',';
    text.append(digits.data(), end.ptr);
}

std::string described(std::uint32_t id, std::int64_t time) {
    return "player " + std::to_string(id) + " at t_ms " + format_milliseconds(time);
}

// Assigns the rows, in the file's order, to the poses of the trace.
class Alignment {
  public:
    explicit Alignment(const Trace& trace)
        : trace_(trace), cameras_(trace.poses.size()), filled_(trace.poses.size(), false) {}

    Result<void> add(std::span<const double> row) {
        const auto time = static_cast<std::int64_t>(std::llround(row[t_ms] * 1e6));
        const auto id = static_cast<std::uint32_t>(row[player]);
        while (frame_ < trace_.frames.size() && trace_.frames[frame_].time < time) {
            if (auto complete = check_frame(); !complete) return complete;
            ++frame_;
        }
        const std::uint32_t pose = find(time, id);
        if (pose == absent) return fail("a row for " + described(id, time) + ", which the trace lacks");
        if (filled_[pose]) return fail("a second row for " + described(id, time));
        const Eigen::Quaterniond orientation(row[qw], row[qx], row[qy], row[qz]);
        if (std::abs(orientation.norm() - 1.0) > 1e-3)
            return fail("the quaternion's length is " + std::to_string(orientation.norm()) + ", expected 1");
        cameras_[pose] = {{row[x], row[y], row[z]}, orientation.normalized(), row[cut] != 0.0};
        filled_[pose] = true;
        return {};
    }

    Result<CameraPath> finish(const std::string& name) {
        for (; frame_ < trace_.frames.size(); ++frame_)
            if (auto complete = check_frame(); !complete) return fail(name + ": " + complete.error().message);
        return std::move(cameras_);
    }

  private:
    [[nodiscard]] std::uint32_t find(std::int64_t time, std::uint32_t id) const {
        if (frame_ == trace_.frames.size() || trace_.frames[frame_].time != time) return absent;
        return pose_of(trace_, trace_.frames[frame_], id);
    }

    [[nodiscard]] Result<void> check_frame() const {
        const TraceFrame& frame = trace_.frames[frame_];
        for (std::uint32_t i = 0; i < frame.pose_count; ++i)
            if (!filled_[frame.first_pose + i])
                return fail("no row for " + described(trace_.poses[frame.first_pose + i].player, frame.time));
        return {};
    }

    const Trace& trace_;
    CameraPath cameras_;
    std::vector<bool> filled_;
    std::size_t frame_ = 0;
};

}  // namespace

std::string format_milliseconds(std::int64_t nanoseconds) {
    std::string text = std::to_string(nanoseconds / 1'000'000);
    const std::int64_t rest = nanoseconds % 1'000'000;
    if (rest == 0) return text;
    std::string decimals = std::to_string(1'000'000 + rest);
    decimals[0] = '.';
    decimals.erase(decimals.find_last_not_of('0') + 1);
    return text + decimals;
}

std::string format_cameras(const Trace& trace, std::span<const CameraSample> cameras) {
    assert(cameras.size() == trace.poses.size());
    std::string text = "t_ms,player,x,y,z,qw,qx,qy,qz,cut\n";
    for (const TraceFrame& frame : trace.frames) {
        const std::string time = format_milliseconds(frame.time);
        for (std::uint32_t i = frame.first_pose; i < frame.first_pose + frame.pose_count; ++i) {
            const CameraSample& camera = cameras[i];
            text += time + ',' + std::to_string(trace.poses[i].player);
            for (const double value : camera.position)
                append(text, value, 5);
            const Eigen::Quaterniond& q = camera.orientation;
            for (const double value : {q.w(), q.x(), q.y(), q.z()})
                append(text, value, 9);
            text += camera.cut ? ",1\n" : ",0\n";
        }
    }
    return text;
}

Result<CameraPath> parse_cameras(std::span<const std::byte> bytes, const std::string& name,
                                 const Trace& trace) {
    Alignment alignment(trace);
    const auto read = read_csv(bytes, name, columns, [&](auto row) { return alignment.add(row); });
    if (!read) return tl::unexpected(read.error());
    return alignment.finish(name);
}

Result<CameraPath> read_cameras(const std::filesystem::path& path, const Trace& trace) {
    const auto bytes = read_file(path);
    if (!bytes) return tl::unexpected(bytes.error());
    return parse_cameras(*bytes, path.string(), trace);
}

}  // namespace camdir::evaluation
