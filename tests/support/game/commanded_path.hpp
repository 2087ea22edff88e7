// The camera that a server commands to one of its spectators, and where a client drew it.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "base/geometry.hpp"
#include "support/game/records.h"

namespace camdir::test {

// Columns of `axes`: forward, left, up.
struct GameView {
    Vec3d position;
    Eigen::Matrix3d axes;
};

[[nodiscard]] Eigen::Matrix3d axes_of(const float angles[3]);
// Where a client that is sent this playerState draws from.
[[nodiscard]] Vec3d eye_of(const witness_player& player);

struct Deviation {
    double offset;  // map units
    double turn;    // degrees
};
[[nodiscard]] Deviation deviation(const drawn_record& picture, const GameView& commanded);

// A picture's pixels, x to the right and y downwards; whole numbers are pixels' corners.
struct PixelBox {
    double left, top, right, bottom;
};

// The smallest box around the picture of a ball in front of the camera; none when the ball reaches behind the
// camera. 90 degrees across the picture's width.
[[nodiscard]] std::optional<PixelBox> picture_of_ball(const GameView& camera, const Vec3d& centre,
                                                      double radius, int width, int height);

// Clients interpolate players between snapshots. A player whom the next snapshot leaves out, because they
// cannot be seen from its camera, or shows elsewhere after a teleport, goes on at their velocity.
enum class Motion { interpolated, extrapolated };

// What one spectator's client was sent, and how it interpolates that: the snapshots of one life of a map.
class CommandedPath {
  public:
    // The last life of the map in the records.
    CommandedPath(const std::vector<witness_record>& records, int spectator_slot);

    struct Snapshot {
        witness_record frame;
        bool cut;  // not interpolated from the snapshot before
    };
    [[nodiscard]] const std::vector<Snapshot>& snapshots() const { return snapshots_; }

    // At a level time in ms, as a client draws it that has the snapshots up to index `newest`.
    [[nodiscard]] GameView view(int time, std::size_t newest) const;
    [[nodiscard]] Vec3d player(int slot, int time, std::size_t newest, Motion motion) const;
    // Index of the snapshot from which the client goes on at that time.
    [[nodiscard]] std::size_t snapshot_at(int time, std::size_t newest) const;
    // Index of the last snapshot that was sent by then (CLOCK_MONOTONIC); none before the first.
    [[nodiscard]] std::optional<std::size_t> newest_at(std::int64_t clock) const;

  private:
    [[nodiscard]] double fraction(std::size_t from, int time) const;

    int spectator_;
    std::vector<Snapshot> snapshots_;
};

// A picture that a client drew, compared with the path.
struct DrawnView {
    GameView view;
    int time;         // level time, in ms, whose commanded view and players fit the picture best
    int latest_time;  // the latest one that fits as well
    // Times that may be meant, because camera and players move less than a unit between them.
    int earliest_guess, latest_guess;
    double offset;       // of the drawn position from the commanded one, map units
    double turn;         // of the drawn axes from the commanded ones, degrees
    double age;          // snapshots from the time drawn to the newest one that the client had
    std::size_t newest;  // index of that snapshot
    std::array<Motion, witness_slots> motions;  // of the players: which fits the picture best
};

// None when the client had none of the path's snapshots yet.
[[nodiscard]] std::optional<DrawnView> locate(const CommandedPath& path, const drawn_record& picture);

}  // namespace camdir::test
