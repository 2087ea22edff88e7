#include "evaluation/quakeworld/tracks.hpp"

#include <array>
#include <map>

#include "quakeworld/tracker.hpp"

namespace camdir::evaluation::quakeworld {
namespace {

using camdir::quakeworld::TrackedFrame;
using camdir::quakeworld::TrackedPose;
using camdir::quakeworld::Tracker;

class TraceBuilder {
  public:
    explicit TraceBuilder(const Demo& demo) : demo_(demo) {
        const std::vector<Slot> slots = slots_of(demo_);
        for (std::size_t player = 0; player < slots.size(); ++player) {
            player_of_[slots[player]] = static_cast<std::uint32_t>(player);
            trace_.players.push_back(static_cast<std::uint32_t>(player));
        }
        number_teams(slots);
        trace_.frames.reserve(demo_.frames.size());
        trace_.poses.reserve(demo_.poses.size());
    }

    Trace build() {
        Tracker tracker;
        for (const DemoFrame& frame : demo_.frames) {
            tracker.add(frame_of(frame));
            take_from(tracker);
        }
        tracker.finish();
        take_from(tracker);
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

    [[nodiscard]] Frame frame_of(const DemoFrame& frame) const {
        const auto first_pose = demo_.poses.begin() + frame.first_pose;
        const auto first_flash = demo_.flashes.begin() + frame.first_flash;
        return {frame.time,
                {first_pose, first_pose + frame.pose_count},
                {first_flash, first_flash + frame.flash_count},
                {}};
    }

    void take_from(Tracker& tracker) {
        while (const auto frame = tracker.next())
            add(*frame);
    }

    void add(const TrackedFrame& frame) {
        trace_.frames.push_back({frame.time * 1'000'000, static_cast<std::uint32_t>(trace_.poses.size()),
                                 static_cast<std::uint32_t>(frame.poses.size())});
        for (const TrackedPose& from : frame.poses) {
            TracePose& pose = trace_.poses.emplace_back();
            pose.player = player_of_[from.slot];
            pose.eye = from.eye;
            pose.orientation = from.orientation;
            pose.velocity = from.velocity;
            pose.view_height = from.view_height;
            pose.team = team_of_[from.slot];
            pose.alive = from.alive;
            pose.discontinuity = from.discontinuity;
        }
    }

    const Demo& demo_;
    Trace trace_;
    std::array<std::uint32_t, max_slots> player_of_{};
    std::array<std::uint8_t, max_slots> team_of_{};
};

}  // namespace

std::vector<Slot> slots_of(const Demo& demo) {
    std::array<bool, max_slots> present{};
    for (const Pose& pose : demo.poses)
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
