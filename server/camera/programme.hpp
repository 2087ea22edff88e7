// The dynamic programme over the knots of a plan: from which direction of the grid, and how far away, the
// camera sees the player at each of them.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>

#include "camera/direction_costs.hpp"

namespace camdir::camera {

struct ProgrammeCosts {
    float length = 120.0F;       // desired; directions are free this far at most
    float shortage = 6.0F;       // times ((length - free length) / (length / 2))^2
    float close = 3.0F;          // of a direction that is free for less than close_share of the length
    float turn = 0.3F;           // times the square of bins turned between two knots
    float stretch = 0.5F;        // times ((change of free length) / (length / 2))^2
    float start_length = -1.0F;  // of the camera before the first knot; negative: no cost of changing it
    static constexpr float close_share = 0.517F;
};

// Minimises the sum over the knots of a direction's own cost and of its shortage of length, and over the
// steps between them of the costs of turning and stretching; at most 2 yaws and 1 elevation a step. Exact,
// but for rounding. Lengths are asked for as late as possible: first the programme is solved as if every
// direction were free, which bounds from below what the rest of a path costs; then the best-first search asks
// for the lengths of the most promising paths only.
class Programme {
  public:
    static constexpr std::size_t knots = 26;
    struct Choice {
        std::uint8_t bin = 0;
        float length = 0.0F;
    };
    // The free length of a knot's direction, 0 .. costs.length. Asked once at most for each.
    using Lengths = std::function<float(std::size_t knot, std::size_t bin)>;

    // One choice a knot; empty when every path is forbidden. Valid until the next call. At most `knots`.
    [[nodiscard]] std::span<const Choice> solve(std::span<const DirectionCosts> direction_costs,
                                                const ProgrammeCosts& costs, const Lengths& lengths);

  private:
    using Row = std::array<float, DirectionGrid::size>;
    static constexpr std::uint16_t unset = 0xffff;

    void bound_from_behind(std::span<const DirectionCosts> direction_costs, float turn);
    [[nodiscard]] float own_cost(float length) const;
    [[nodiscard]] float best_arrival(std::size_t knot, std::size_t bin);
    void arrive(std::size_t knot, std::size_t bin, float estimate);
    [[nodiscard]] std::uint16_t take_first();
    void sift_up(std::size_t position);
    void sift_down(std::size_t position);

    std::span<const DirectionCosts> direction_costs_;
    ProgrammeCosts costs_;
    std::array<Row, knots> rest_;      // lower bound of what comes after a choice
    std::array<Row, knots> length_;    // negative: not asked yet
    std::array<Row, knots> own_;       // cost of the length; 0 while it is not known
    std::array<Row, knots> cost_;      // up to and with a choice, once it is closed; else infinity
    std::array<Row, knots> estimate_;  // of the whole path, of what is open
    std::array<std::array<std::uint8_t, DirectionGrid::size>, knots> parent_;
    std::array<std::uint16_t, knots * DirectionGrid::size>
        heap_;  // open choices, the smallest estimate first
    std::array<std::uint16_t, knots * DirectionGrid::size> place_;  // in the heap; unset
    std::size_t heap_size_ = 0;
    std::array<Choice, knots> choices_;
};

}  // namespace camdir::camera
