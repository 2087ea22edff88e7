#include "evaluation/trace.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "evaluation/csv.hpp"
#include "evaluation/match.hpp"

namespace camdir::evaluation {
namespace {

constexpr std::size_t max_players = 256;
constexpr double largest_time_ms = 1e12;
constexpr double largest_angle = 1e6;

enum Field {
    t_ms,
    player,
    x,
    y,
    z,
    pitch,
    yaw,
    roll,
    vx,
    vy,
    vz,
    viewheight,
    team,
    teleport_bit,
    alive,
    field_count
};

constexpr Column columns[] = {
    {"t_ms", 0.0, largest_time_ms},
    {"player", 0.0, 4294967294.0, true},
    {"x", -largest_coordinate, largest_coordinate},
    {"y", -largest_coordinate, largest_coordinate},
    {"z", -largest_coordinate, largest_coordinate},
    {"pitch", -largest_angle, largest_angle},
    {"yaw", -largest_angle, largest_angle},
    {"roll", -largest_angle, largest_angle},
    {"vx", -largest_coordinate, largest_coordinate},
    {"vy", -largest_coordinate, largest_coordinate},
    {"vz", -largest_coordinate, largest_coordinate},
    {"viewheight", -1000.0, 1000.0},
    {"team", 0.0, 255.0, true},
    {"teleport_bit", 0.0, 1.0, true},
    {"alive", 0.0, 1.0, true},
};
static_assert(std::size(columns) == field_count);

TracePose to_pose(std::span<const double> row) {
    TracePose pose;
    pose.player = static_cast<std::uint32_t>(row[player]);
    pose.eye = {row[x], row[y], row[z] + row[viewheight]};
    pose.orientation = quake_orientation(row[pitch], row[yaw], row[roll]);
    pose.velocity = {row[vx], row[vy], row[vz]};
    pose.view_height = static_cast<float>(row[viewheight]);
    pose.team = static_cast<std::uint8_t>(row[team]);
    pose.alive = row[alive] != 0.0;
    return pose;
}

bool by_player(const TracePose& a, const TracePose& b) {
    return a.player < b.player;
}

// Takes the rows in the file's order.
class Assembly {
  public:
    Result<void> add(std::span<const double> row) {
        const auto time = static_cast<std::int64_t>(std::llround(row[t_ms] * 1e6));
        if (trace_.frames.empty() || time != trace_.frames.back().time) {
            if (auto started = start_frame(time); !started) return started;
        }
        TracePose pose = to_pose(row);
        auto seen = last_seen_.find(pose.player);
        if (seen == last_seen_.end()) {
            if (last_seen_.size() == max_players)
                return fail("column \"player\" has more than " + std::to_string(max_players) +
                            " different players");
            seen = last_seen_.emplace(pose.player, LastSeen{}).first;
        } else if (seen->second.frame == trace_.frames.size()) {
            return fail("a second row for player " + std::to_string(pose.player) + " at the same t_ms");
        }
        const bool bit = row[teleport_bit] != 0.0;
        const LastSeen now{trace_.frames.size(), bit, pose.alive};
        const LastSeen before = std::exchange(seen->second, now);
        pose.discontinuity =
            before.frame + 1 != now.frame || before.bit != bit || (pose.alive && !before.alive);
        trace_.poses.push_back(pose);
        ++trace_.frames.back().pose_count;
        return {};
    }

    Result<Trace> finish(const std::string& name) {
        if (trace_.frames.empty()) return fail(name + ": no rows, expected at least one frame");
        close_frame();
        for (const auto& [id, seen] : last_seen_)
            trace_.players.push_back(id);
        return std::move(trace_);
    }

  private:
    struct LastSeen {
        std::size_t frame = 0;  // counted from 1; 0 = never
        bool bit = false;
        bool alive = false;
    };

    Result<void> start_frame(std::int64_t time) {
        if (!trace_.frames.empty()) {
            if (time < trace_.frames.back().time)
                return fail("column \"t_ms\" goes back, expected rows ordered by time");
            close_frame();
        }
        if (trace_.poses.size() > std::numeric_limits<std::uint32_t>::max() - 2 * max_players)
            return fail("more than 4294966783 rows");
        trace_.frames.push_back({time, static_cast<std::uint32_t>(trace_.poses.size()), 0});
        return {};
    }

    void close_frame() {
        const auto first = trace_.poses.begin() + trace_.frames.back().first_pose;
        if (!std::is_sorted(first, trace_.poses.end(), by_player))
            std::sort(first, trace_.poses.end(), by_player);
    }

    Trace trace_;
    std::map<std::uint32_t, LastSeen> last_seen_;
};

}  // namespace

std::uint32_t pose_of(const Trace& trace, const TraceFrame& frame, std::uint32_t player) {
    const auto poses = trace.poses_of(frame);
    TracePose key;
    key.player = player;
    const auto found = std::lower_bound(poses.begin(), poses.end(), key, by_player);
    if (found == poses.end() || found->player != player) return absent;
    return frame.first_pose + static_cast<std::uint32_t>(found - poses.begin());
}

std::vector<std::uint32_t> track_of(const Trace& trace, std::uint32_t player) {
    std::vector<std::uint32_t> track;
    track.reserve(trace.frames.size());
    for (const TraceFrame& frame : trace.frames)
        track.push_back(pose_of(trace, frame, player));
    return track;
}

Result<Trace> parse_trace(std::span<const std::byte> bytes, const std::string& name) {
    Assembly assembly;
    const auto read = read_csv(bytes, name, columns, [&](auto row) { return assembly.add(row); });
    if (!read) return tl::unexpected(read.error());
    return assembly.finish(name);
}

Result<Trace> read_trace(const std::filesystem::path& path) {
    auto match = read_match(path);
    if (!match) return tl::unexpected(match.error());
    return std::move(match->trace);
}

}  // namespace camdir::evaluation
