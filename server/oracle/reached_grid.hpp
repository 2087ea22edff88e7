// Which cells of a regular grid can be reached from the spawn points through free space.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <stop_token>
#include <unordered_map>
#include <vector>

#include "base/error.hpp"
#include "base/point_grid.hpp"
#include "oracle/oracle.hpp"

namespace camdir::oracle {

// 8 units of 0.0254 m, in the scene's units.
[[nodiscard]] double grid_pitch(const scene::Scene& scene);

// How far an exploration is: the cells visited so far. Called now and then, from the exploring thread; may be
// empty.
using ExploreProgress = std::function<void(std::uint64_t cells)>;

// The memory that a grid may take at most.
inline constexpr std::uint64_t max_grid_bytes = std::uint64_t{2} << 30U;

// The flood from the scene's spawn points, within its bounds, over the 6 neighbours of each cell, through
// cells whose centre has more clearance than `min_clearance`. With min_clearance >= pitch / 2 the segment
// between neighbouring centres is free. A spawn point's eye starts the flood at all centres around it that it
// sees.
//
// Immutable; const members are thread-safe. The oracle must outlive it.
class ReachedGrid {
  public:
    // `pitch` > 0, `min_clearance` > 0. Fails before it allocates anything when all cells of the bounds would
    // take more than max_grid_bytes, or min_clearance is more than 33 pitches; with ErrorCode::interrupted
    // soon after `stop` is requested.
    [[nodiscard]] static Result<ReachedGrid> explore(const Oracle& oracle, const scene::Scene& scene,
                                                     double pitch, double min_clearance,
                                                     const ExploreProgress& progress,
                                                     const std::stop_token& stop);

    // The centre of the cell that holds `point` was reached.
    [[nodiscard]] bool reached(const Vec3d& point) const;

    // `point` is in no solid and a free segment joins it to the centre of a reached cell within
    // 3 min_clearance + 2 pitch of it.
    [[nodiscard]] bool joined(const Vec3d& point) const;

    // Holds every point for which joined() may be true; empty when nothing was reached.
    [[nodiscard]] const Box3d& joined_box() const { return joined_box_; }
    [[nodiscard]] std::size_t reached_count() const { return reached_count_; }

  private:
    using Cell = Eigen::Vector3i;
    // 8 x 8 x 8 cells, a bit each: slice z, then 8 y + x.
    using Slices = std::array<std::uint64_t, 8>;
    struct Block {
        Slices open{};     // enough clearance
        Slices reached{};  // subset of open
    };
    // A cell within its block.
    struct Place {
        explicit Place(const Cell& cell);
        Cell block;
        std::size_t slice;
        std::uint64_t bit;
    };

    ReachedGrid(const Oracle& oracle, const Box3d& bounds, double pitch, double min_clearance);
    [[nodiscard]] Cell cell_of(const Vec3d& point) const;
    [[nodiscard]] Vec3d centre_of(const Cell& cell) const;
    [[nodiscard]] bool is_inside(const Cell& cell) const;
    [[nodiscard]] bool reached(const Cell& cell) const;
    [[nodiscard]] bool has_blocks_near(const Cell& cell) const;
    [[nodiscard]] Block& block_at(const Cell& block);
    void find_open(const Cell& first, int size, Slices& open) const;
    // Both return early when `stop` is requested.
    void flood(std::vector<Cell> frontier, const ExploreProgress& progress, const std::stop_token& stop);
    void seed(const Vec3d& point, std::vector<Cell>& frontier, const std::stop_token& stop);
    void spread(const Cell& block, std::vector<Cell>& frontier);
    void summarise();

    const Oracle* oracle_;
    Box3d bounds_;
    double pitch_;
    double min_clearance_;
    double largest_coordinate_;  // within the bounds
    double sight_;               // how far away joined() looks for a centre
    std::vector<Cell> near_;     // offsets of the cells that may lie so near, nearest first
    std::unordered_map<Cell, Block, TripleHash> blocks_;
    Box3d joined_box_;
    std::size_t reached_count_ = 0;
};

}  // namespace camdir::oracle
