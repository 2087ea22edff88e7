#include "camera/programme.hpp"

#include <algorithm>
#include <cassert>
#include <limits>

#include "base/float4.hpp"

namespace camdir::camera {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr std::size_t grid_yaws = DirectionGrid::yaws;
constexpr std::size_t grid_elevations = DirectionGrid::elevations;
constexpr int yaw_reach = 2;
static_assert(grid_yaws % lane_count == 0);

float square(float value) {
    return value * value;
}

struct Neighbour {
    std::uint8_t bin;
    float turned;  // squared bins
};

// The directions that a step can lead to from each bin, and come from.
struct Neighbours {
    static constexpr std::size_t most = std::size_t{3} * (2 * yaw_reach + 1);
    std::array<std::array<Neighbour, most>, DirectionGrid::size> lists;
    std::array<std::uint8_t, DirectionGrid::size> counts{};

    constexpr Neighbours() : lists{} {
        for (std::size_t bin = 0; bin < DirectionGrid::size; ++bin)
            for (int rise = -1; rise <= 1; ++rise)
                for (int turn = -yaw_reach; turn <= yaw_reach; ++turn)
                    add(bin, rise, turn);
    }
    [[nodiscard]] std::span<const Neighbour> of(std::size_t bin) const {
        return std::span(lists[bin]).first(counts[bin]);
    }

  private:
    constexpr void add(std::size_t bin, int rise, int turn) {
        const int elevation = static_cast<int>(bin / grid_yaws) + rise;
        if (elevation < 0 || elevation >= static_cast<int>(grid_elevations)) return;
        const int yaw = (static_cast<int>(bin % grid_yaws) + turn + static_cast<int>(grid_yaws)) %
                        static_cast<int>(grid_yaws);
        lists[bin][counts[bin]++] = {static_cast<std::uint8_t>(elevation * static_cast<int>(grid_yaws) + yaw),
                                     static_cast<float>(turn * turn + rise * rise)};
    }
};
constexpr Neighbours neighbours;

}  // namespace

float Programme::own_cost(float length) const {
    const float half = 0.5F * costs_.length;
    return costs_.shortage * square((costs_.length - length) / half) +
           (length < ProgrammeCosts::close_share * costs_.length ? costs_.close : 0.0F);
}

// The least sum of direction costs and turns after each choice, as if every direction were free: separable in
// yaw and elevation.
void Programme::bound_from_behind(std::span<const DirectionCosts> direction_costs, float turn) {
    const std::size_t last = direction_costs.size() - 1;
    rest_[last].fill(0.0F);
    Row turned;
    for (std::size_t knot = last; knot-- > 0;) {
        for (std::size_t elevation = 0; elevation < grid_elevations; ++elevation) {
            const std::size_t first = elevation * grid_yaws;
            std::array<float, grid_yaws + 2 * yaw_reach> row;  // and on round the circle at either end
            for (std::size_t i = 0; i < grid_yaws; i += lane_count)
                store(load(&direction_costs[knot + 1][first + i]) + load(&rest_[knot + 1][first + i]),
                      &row[i + yaw_reach]);
            for (std::size_t i = 0; i < yaw_reach; ++i) {
                row[i] = row[i + grid_yaws];
                row[i + grid_yaws + yaw_reach] = row[i + yaw_reach];
            }
            for (std::size_t i = 0; i < grid_yaws; i += lane_count) {
                const float* const at = &row[i];
                const Float4 one = smaller(load(at + 1), load(at + 3)) + turn;
                const Float4 two = smaller(load(at), load(at + 4)) + 4.0F * turn;
                store(smaller(load(at + 2), smaller(one, two)), &turned[first + i]);
            }
        }
        for (std::size_t bin = 0; bin < turned.size(); bin += lane_count) {
            Float4 least = load(&turned[bin]);
            if (bin >= grid_yaws) least = smaller(least, load(&turned[bin - grid_yaws]) + turn);
            if (bin + grid_yaws < turned.size())
                least = smaller(least, load(&turned[bin + grid_yaws]) + turn);
            store(least, &rest_[knot][bin]);
        }
    }
}

// The least cost of coming to a choice from those that are closed, without its own; notes from which.
float Programme::best_arrival(std::size_t knot, std::size_t bin) {
    const float half = 0.5F * costs_.length;
    const float length = length_[knot][bin];
    if (knot == 0) {
        return costs_.start_length < 0.0F ? 0.0F
                                          : costs_.stretch * square((length - costs_.start_length) / half);
    }
    float least = infinity;
    for (const auto& [from, turned] : neighbours.of(bin)) {
        const float before = cost_[knot - 1][from];
        if (before == infinity) continue;
        const float change = (length - length_[knot - 1][from]) / half;
        const float cost = before + costs_.turn * turned + costs_.stretch * square(change);
        if (cost >= least) continue;
        least = cost;
        parent_[knot][bin] = from;
    }
    return least;
}

std::span<const Programme::Choice> Programme::solve(std::span<const DirectionCosts> direction_costs,
                                                    const ProgrammeCosts& costs, const Lengths& lengths) {
    assert(!direction_costs.empty() && direction_costs.size() <= knots);
    direction_costs_ = direction_costs;
    costs_ = costs;
    bound_from_behind(direction_costs, costs.turn);
    const std::size_t count = direction_costs.size();
    for (std::size_t knot = 0; knot < count; ++knot) {
        length_[knot].fill(-1.0F);
        own_[knot].fill(0.0F);
        cost_[knot].fill(infinity);
    }
    std::fill_n(place_.begin(), count * DirectionGrid::size, unset);
    heap_size_ = 0;
    for (std::size_t bin = 0; bin < DirectionGrid::size; ++bin) {
        if (direction_costs[0][bin] < forbidden) arrive(0, bin, direction_costs[0][bin] + rest_[0][bin]);
    }
    while (heap_size_ > 0) {
        const std::size_t state = take_first();
        const std::size_t knot = state / DirectionGrid::size;
        const std::size_t bin = state % DirectionGrid::size;
        const float promised = estimate_[knot][bin];
        if (length_[knot][bin] < 0.0F) {
            length_[knot][bin] = lengths(knot, bin);
            own_[knot][bin] = own_cost(length_[knot][bin]);
        }
        const float cost = best_arrival(knot, bin) + direction_costs[knot][bin] + own_[knot][bin];
        if (cost + rest_[knot][bin] > promised + 1e-5F) {
            arrive(knot, bin, cost + rest_[knot][bin]);
            continue;
        }
        cost_[knot][bin] = cost;
        if (knot + 1 == count) {
            std::size_t at = bin;
            for (std::size_t k = count; k-- > 0;) {
                choices_[k] = {static_cast<std::uint8_t>(at), length_[k][at]};
                at = parent_[k][at];
            }
            return {choices_.data(), count};
        }
        for (const auto& [to, turned] : neighbours.of(bin)) {
            if (direction_costs[knot + 1][to] >= forbidden || cost_[knot + 1][to] != infinity) continue;
            arrive(knot + 1, to,
                   cost + costs_.turn * turned + direction_costs[knot + 1][to] + own_[knot + 1][to] +
                       rest_[knot + 1][to]);
        }
    }
    return {};
}

// Opens a choice, or improves the estimate of an open one.
void Programme::arrive(std::size_t knot, std::size_t bin, float estimate) {
    if (estimate >= forbidden) return;
    const auto state = static_cast<std::uint16_t>(knot * DirectionGrid::size + bin);
    if (place_[state] == unset) {
        place_[state] = static_cast<std::uint16_t>(heap_size_);
        heap_[heap_size_++] = state;
    } else if (estimate >= estimate_[knot][bin]) {
        return;
    }
    estimate_[knot][bin] = estimate;
    sift_up(place_[state]);
}

std::uint16_t Programme::take_first() {
    const std::uint16_t first = heap_[0];
    place_[first] = unset;
    const std::uint16_t moved = heap_[--heap_size_];
    if (heap_size_ > 0) {
        heap_[0] = moved;
        place_[moved] = 0;
        sift_down(0);
    }
    return first;
}

void Programme::sift_up(std::size_t position) {
    const float* const estimates = estimate_[0].data();
    const std::uint16_t state = heap_[position];
    while (position > 0) {
        const std::size_t above = (position - 1) / 2;
        if (estimates[heap_[above]] <= estimates[state]) break;
        heap_[position] = heap_[above];
        place_[heap_[position]] = static_cast<std::uint16_t>(position);
        position = above;
    }
    heap_[position] = state;
    place_[state] = static_cast<std::uint16_t>(position);
}

void Programme::sift_down(std::size_t position) {
    const float* const estimates = estimate_[0].data();
    const std::uint16_t state = heap_[position];
    for (;;) {
        std::size_t below = 2 * position + 1;
        if (below >= heap_size_) break;
        if (below + 1 < heap_size_ && estimates[heap_[below + 1]] < estimates[heap_[below]]) ++below;
        if (estimates[heap_[below]] >= estimates[state]) break;
        heap_[position] = heap_[below];
        place_[heap_[position]] = static_cast<std::uint16_t>(position);
        position = below;
    }
    heap_[position] = state;
    place_[state] = static_cast<std::uint16_t>(position);
}

}  // namespace camdir::camera
