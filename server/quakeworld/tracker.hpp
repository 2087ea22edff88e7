// What a demo does not say of its players, out of neighbouring frames: velocities, and where a player
// respawned or teleported.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "quakeworld/frames.hpp"

namespace camdir::quakeworld {

struct TrackedPose {
    Slot slot = 0;
    Vec3d eye = Vec3d::Zero();
    Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
    Vec3d velocity = Vec3d::Zero();  // map units a second
    float view_height = 0.0F;        // of the eye over the player's origin
    bool alive = true;
    bool discontinuity = false;  // respawned, teleported, or first seen since the frame before
};

struct TrackedFrame {
    std::int64_t time = 0;           // ms since the demo's begin
    std::vector<TrackedPose> poses;  // those of the frame, in its order
    std::vector<Occurrence> occurrences;
};

// Follows the players over the frames of one level. A server turns a player whom it displaced some frames
// late: from the displacement on, the view is what it settles in. So a frame comes out when it is known what
// follows in the next 120 ms.
class Tracker {
  public:
    // Times ascend strictly. Of a frame without poses the occurrences are added to the frame before; those
    // where nobody has played for long are lost.
    void add(Frame frame);
    // No frame follows.
    void finish() { finished_ = true; }
    // The next frame; nothing while it depends on what is not known yet.
    [[nodiscard]] std::optional<TrackedFrame> next();

  private:
    // A player between two frames; absent: not in the frame.
    struct Member {
        const Pose* pose = nullptr;
        bool discontinuity = false;
    };
    struct Entry {
        [[nodiscard]] Member member(Slot slot) const;

        Frame frame;
        std::vector<bool> discontinuities;  // of each pose
    };
    // A view that holds until a frame.
    struct Held {
        std::size_t until = 0;  // number of the frame that has it of its own
        Vec3d angles = Vec3d::Zero();
    };

    [[nodiscard]] bool is_ready() const;
    [[nodiscard]] bool displaced(const Frame& frame, const Pose& pose) const;
    [[nodiscard]] std::size_t end_of_turns(Slot slot) const;
    [[nodiscard]] Vec3d settled_angles(const Pose& pose, bool discontinuity);
    [[nodiscard]] Vec3d velocity(const Pose& pose, bool discontinuity) const;

    std::deque<Entry> window_;     // the next frame is the first
    std::optional<Entry> before_;  // the frame that came out last
    std::size_t number_ = 0;       // of the next frame
    std::int64_t newest_ = 0;      // time of the frame that was added last
    std::array<Held, max_slots> held_{};
    bool finished_ = false;
};

}  // namespace camdir::quakeworld
