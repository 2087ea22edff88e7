// The doors and lifts of a recorded match as they are at one time.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "evaluation/mover_tracks.hpp"
#include "oracle/mover.hpp"
#include "scene/scene.hpp"

namespace camdir::evaluation {

// By the source map's own planes. Needs the movers for as long as it is asked; thread-safe.
class PlacedMovers {
  public:
    // Nothing moves.
    PlacedMovers() = default;
    // `tracks` are of `movers`. Those that were not seen yet are nowhere.
    PlacedMovers(std::span<const scene::Mover> movers, const MoverTracks& tracks, std::int64_t time);

    // One touches the closed segment.
    [[nodiscard]] bool touch(const Vec3d& from, const Vec3d& to) const {
        return meet(*this, from, *this, to);
    }
    [[nodiscard]] bool hold(const Vec3d& point) const { return touch(point, point); }
    // One is between two points. Who sits in a vehicle sees and is seen as if nothing moved.
    [[nodiscard]] bool hide(const Vec3d& from, const Vec3d& to) const {
        return touch(from, to) && !hold(from) && !hold(to);
    }

    // One meets the point that goes from one place to the other while they move. Both are of the same movers.
    [[nodiscard]] static bool meet(const PlacedMovers& before, const Vec3d& from, const PlacedMovers& after,
                                   const Vec3d& to);

  private:
    std::span<const scene::Mover> movers_;
    std::vector<std::optional<oracle::Placement>> placements_;  // by mover
};

}  // namespace camdir::evaluation
