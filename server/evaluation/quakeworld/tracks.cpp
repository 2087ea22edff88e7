#include "evaluation/quakeworld/tracks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <span>

namespace camdir::evaluation::quakeworld {
namespace {

// Of the eye over the origin, map units.
constexpr float view_height = 22.0F;
constexpr float view_height_dead = -16.0F;
constexpr float view_height_gibbed = 8.0F;

constexpr double fastest = 2000.0;  // units/s, of the server's default limit in one axis: beyond, displaced
constexpr double fastest_run = 640.0;
constexpr double shortest_teleport = 48.0;  // units
constexpr double flash_reach = 96.0;        // units between the flash of a teleport and its player
constexpr std::int64_t late_turn_ms = 120;  // until which a server turns a player whom it has displaced
constexpr double late_turn = 20.0;          // degrees in one frame, at least

// The player's poses that follow each other in the frames of a demo.
struct Track {
    std::vector<std::uint32_t> poses;   // indices into Demo::poses
    std::vector<std::uint32_t> frames;  // of each
};

class TraceBuilder {
  public:
    explicit TraceBuilder(const Demo& demo) : demo_(demo) {}

    Trace build() {
        const std::vector<Slot> slots = slots_of(demo_);
        for (std::size_t player = 0; player < slots.size(); ++player) {
            player_of_[slots[player]] = static_cast<std::uint32_t>(player);
            trace_.players.push_back(static_cast<std::uint32_t>(player));
        }
        number_teams(slots);
        trace_.frames.reserve(demo_.frames.size());
        trace_.poses.reserve(demo_.poses.size());
        std::vector<Track> tracks(slots.size());
        for (std::size_t frame = 0; frame < demo_.frames.size(); ++frame)
            add_frame(static_cast<std::uint32_t>(frame), tracks);
        for (const Track& track : tracks) {
            mark_discontinuities(track);
            orient(track, settled_angles(track));
            set_velocities(track);
        }
        return std::move(trace_);
    }

  private:
    // Without teamplay everyone is everyone's enemy: team 0.
    void number_teams(const std::vector<Slot>& slots) {
        if (!demo_.teamplay) return;
        std::map<std::string, std::uint8_t> numbers;
        for (const Slot slot : slots)
            team_of_[slot] = numbers.emplace(demo_.teams[slot], static_cast<std::uint8_t>(numbers.size() + 1))
                                 .first->second;
    }

    void add_frame(std::uint32_t number, std::vector<Track>& tracks) {
        const DemoFrame& frame = demo_.frames[number];
        trace_.frames.push_back({frame.time * 1'000'000, frame.first_pose, frame.pose_count});
        for (std::uint32_t i = 0; i < frame.pose_count; ++i) {
            const DemoPose& from = demo_.poses[frame.first_pose + i];
            TracePose pose;
            pose.player = player_of_[from.slot];
            pose.view_height = from.alive ? view_height : from.gibbed ? view_height_gibbed : view_height_dead;
            pose.eye = from.origin + Vec3d(0.0, 0.0, pose.view_height);
            pose.team = team_of_[from.slot];
            pose.alive = from.alive;
            trace_.poses.push_back(pose);
            tracks[pose.player].poses.push_back(frame.first_pose + i);
            tracks[pose.player].frames.push_back(number);
        }
    }

    void mark_discontinuities(const Track& track) {
        for (std::size_t i = 0; i < track.poses.size(); ++i)
            trace_.poses[track.poses[i]].discontinuity = i == 0 || displaced(track, i);
    }

    [[nodiscard]] bool displaced(const Track& track, std::size_t i) const {
        if (track.frames[i] != track.frames[i - 1] + 1) return true;
        const DemoPose& before = demo_.poses[track.poses[i - 1]];
        const DemoPose& now = demo_.poses[track.poses[i]];
        if (now.alive && !before.alive) return true;
        const double moved = (now.origin - before.origin).norm();
        const double seconds = seconds_between(track, i - 1, i);
        if (moved > fastest * seconds + 8.0) return true;
        return moved > std::max(shortest_teleport, fastest_run * seconds + 32.0) &&
               flashes_near(now.origin, demo_.frames[track.frames[i]]);
    }

    [[nodiscard]] bool flashes_near(const Vec3d& place, const DemoFrame& frame) const {
        return std::ranges::any_of(std::span(demo_.flashes).subspan(frame.first_flash, frame.flash_count),
                                   [&](const Vec3d& flash) { return (flash - place).norm() < flash_reach; });
    }

    // A server turns a player whom it displaces some frames later, perhaps twice, as the player's own
    // commands from before may turn them back in between: until the last such turn the view is what it ends
    // in.
    [[nodiscard]] std::vector<Vec3d> settled_angles(const Track& track) const {
        std::vector<Vec3d> angles;
        for (const std::uint32_t pose : track.poses)
            angles.push_back(demo_.poses[pose].angles);
        for (std::size_t i = 0; i < track.poses.size(); ++i) {
            const TracePose& pose = trace_.poses[track.poses[i]];
            if (!pose.discontinuity || !pose.alive) continue;
            const std::size_t settled = end_of_turns(track, angles, i);
            std::fill(angles.begin() + static_cast<std::ptrdiff_t>(i),
                      angles.begin() + static_cast<std::ptrdiff_t>(settled), angles[settled]);
        }
        return angles;
    }

    // The pose with which the last of the large turns after the displacement at `first` ends; `first` itself
    // when there is none. Large: also more than half of the largest.
    [[nodiscard]] std::size_t end_of_turns(const Track& track, const std::vector<Vec3d>& angles,
                                           std::size_t first) const {
        std::vector<double> turns = {0.0};
        for (std::size_t i = first + 1; i < track.poses.size(); ++i) {
            const TracePose& pose = trace_.poses[track.poses[i]];
            if (pose.discontinuity || !pose.alive || time(track, i) - time(track, first) > late_turn_ms)
                break;
            turns.push_back(angle_between(angles[i - 1], angles[i]));
        }
        const double large = std::max(late_turn, 0.5 * *std::ranges::max_element(turns));
        for (std::size_t i = turns.size() - 1; i > 0; --i)
            if (turns[i] > large) return first + i;
        return first;
    }

    [[nodiscard]] static double angle_between(const Vec3d& a, const Vec3d& b) {
        const auto forward = [](const Vec3d& angles) -> Vec3d {
            return quake_orientation(angles[0], angles[1], 0.0) * Vec3d::UnitX();
        };
        return std::acos(std::clamp(forward(a).dot(forward(b)), -1.0, 1.0)) / radians_of_a_degree<double>;
    }

    void orient(const Track& track, const std::vector<Vec3d>& angles) {
        for (std::size_t i = 0; i < track.poses.size(); ++i)
            trace_.poses[track.poses[i]].orientation =
                quake_orientation(angles[i][0], angles[i][1], angles[i][2]);
    }

    // From the frame before to the frame after, as far as the player was not displaced.
    void set_velocities(const Track& track) {
        for (std::size_t i = 0; i < track.poses.size(); ++i) {
            TracePose& pose = trace_.poses[track.poses[i]];
            const bool last = i + 1 == track.poses.size() || trace_.poses[track.poses[i + 1]].discontinuity;
            const std::size_t from = pose.discontinuity ? i : i - 1;
            const std::size_t to = last ? i : i + 1;
            if (from == to) continue;
            pose.velocity = (demo_.poses[track.poses[to]].origin - demo_.poses[track.poses[from]].origin) /
                            seconds_between(track, from, to);
        }
    }

    [[nodiscard]] std::int64_t time(const Track& track, std::size_t i) const {
        return demo_.frames[track.frames[i]].time;
    }
    [[nodiscard]] double seconds_between(const Track& track, std::size_t i, std::size_t j) const {
        return static_cast<double>(time(track, j) - time(track, i)) * 1e-3;
    }

    const Demo& demo_;
    Trace trace_;
    std::array<std::uint32_t, max_slots> player_of_{};
    std::array<std::uint8_t, max_slots> team_of_{};
};

}  // namespace

std::vector<Slot> slots_of(const Demo& demo) {
    std::array<bool, max_slots> present{};
    for (const DemoPose& pose : demo.poses)
        present[pose.slot] = true;
    std::vector<Slot> slots;
    for (std::size_t slot = 0; slot < max_slots; ++slot)
        if (present[slot]) slots.push_back(static_cast<Slot>(slot));
    return slots;
}

Trace trace_of(const Demo& demo) {
    return TraceBuilder(demo).build();
}

}  // namespace camdir::evaluation::quakeworld
