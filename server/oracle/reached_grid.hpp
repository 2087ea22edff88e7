// Which cells of a regular grid can be reached from the spawn points through free space.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "base/point_grid.hpp"
#include "oracle/oracle.hpp"

namespace camdir::oracle {

// 8 units of 0.0254 m, in the scene's units.
[[nodiscard]] double grid_pitch(const scene::Scene& scene);
[[nodiscard]] std::vector<Vec3d> spawn_eyes(const scene::Scene& scene);

// The flood from `seeds` over the 6 neighbours of each cell, through cells whose centre has more
// clearance than `min_clearance`. With min_clearance >= pitch / 2 neighbouring centres are joined by free
// space for certain. Seeds enter at all centres around them that they see.
//
// Immutable after construction; const members are thread-safe. The oracle must outlive it.
class ReachedGrid {
  public:
    ReachedGrid(const Oracle& oracle, const Box3d& bounds, const std::vector<Vec3d>& seeds, double pitch,
                double min_clearance);

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

    [[nodiscard]] Cell cell_of(const Vec3d& point) const;
    [[nodiscard]] Vec3d centre_of(const Cell& cell) const;
    [[nodiscard]] bool is_inside(const Cell& cell) const;
    [[nodiscard]] bool reached(const Cell& cell) const;
    [[nodiscard]] bool has_blocks_near(const Cell& cell) const;
    [[nodiscard]] Block& block_at(const Cell& block);
    void find_open(const Cell& first, int size, Slices& open) const;
    void flood(std::vector<Cell> frontier);
    void seed(const Vec3d& point, std::vector<Cell>& frontier);
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
