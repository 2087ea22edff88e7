#include "oracle/reached_grid.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace camdir::oracle {
namespace {

using Cell = Eigen::Vector3i;
constexpr int block_side = 8;
constexpr std::uint64_t cells_of_a_block = block_side * block_side * block_side;

// A block in the map of blocks, with its node and bucket, and its places in the frontier.
constexpr double bytes_of_a_block = 256.0;
// In pitches: the largest d0 of a bake, 32, and some rounding. Bounds the cells that joined() looks at.
constexpr double max_clearance = 33.0;

// How far away joined() looks for a centre.
double sight_of(double pitch, double min_clearance) {
    return 3.0 * min_clearance + 2.0 * pitch;
}

int floor_div(int value) {
    return (value - (value < 0 ? block_side - 1 : 0)) / block_side;
}

// Offsets of cells whose centre may lie within `radius` cells of a point of the middle cell.
std::vector<Cell> offsets_within(double radius) {
    const int reach = static_cast<int>(std::ceil(radius));
    std::vector<Cell> offsets;
    for (int z = -reach; z <= reach; ++z) {
        for (int y = -reach; y <= reach; ++y) {
            for (int x = -reach; x <= reach; ++x) {
                if (x * x + y * y + z * z <= radius * radius) offsets.emplace_back(x, y, z);
            }
        }
    }
    std::stable_sort(offsets.begin(), offsets.end(),
                     [](const Cell& a, const Cell& b) { return a.squaredNorm() < b.squaredNorm(); });
    return offsets;
}

double max_bytes(const Box3d& bounds, double pitch) {
    const Vec3d blocks = (bounds.sizes() / (pitch * block_side)).array().floor() + 1.0;
    return blocks.prod() * bytes_of_a_block;
}

Result<void> check_size(const scene::Scene& scene, double pitch) {
    constexpr double megabyte = 1e6;
    constexpr double million = 1e6;
    const double bytes = max_bytes(scene.bounds, pitch);
    if (bytes <= static_cast<double>(max_grid_bytes)) return {};
    const Vec3d size = scene.bounds.sizes();
    std::ostringstream text;
    text << scene.source << ": the bounds of " << std::fixed << std::setprecision(0) << size.x() << " x "
         << size.y() << " x " << size.z() << " map units hold " << (size / pitch).prod() / million
         << " million cells of " << std::defaultfloat << std::setprecision(4) << pitch << std::fixed
         << std::setprecision(0) << " units, which may take " << bytes / megabyte
         << " MB to explore; the limit is " << static_cast<double>(max_grid_bytes) / megabyte
         << " MB: cut the map to the part that players can be in";
    return fail(text.str());
}

Result<void> check_clearance(const scene::Scene& scene, double pitch, double min_clearance) {
    if (min_clearance <= max_clearance * pitch) return {};
    std::ostringstream text;
    text << scene.source << ": free space with a clearance of " << min_clearance
         << " map units cannot be explored in cells of " << pitch << "; the limit is "
         << max_clearance * pitch;
    return fail(text.str());
}

}  // namespace

double grid_pitch(const scene::Scene& scene) {
    return 8.0 * metres_of_nominal_unit / scene.metres_per_unit;
}

ReachedGrid::Place::Place(const Cell& cell)
    : block(floor_div(cell.x()), floor_div(cell.y()), floor_div(cell.z())) {
    const Cell local = cell - block * block_side;
    slice = static_cast<std::size_t>(local.z());
    bit = std::uint64_t{1} << (8 * local.y() + local.x());
}

Result<ReachedGrid> ReachedGrid::explore(const Oracle& oracle, const scene::Scene& scene, double pitch,
                                         double min_clearance, const ExploreProgress& progress,
                                         const std::stop_token& stop) {
    assert(pitch > 0.0 && min_clearance > 0.0);
    if (auto fits = check_size(scene, pitch); !fits) return tl::unexpected(std::move(fits.error()));
    if (auto fits = check_clearance(scene, pitch, min_clearance); !fits)
        return tl::unexpected(std::move(fits.error()));
    ReachedGrid grid(oracle, scene.bounds, pitch, min_clearance);
    std::vector<Cell> frontier;
    for (const scene::SpawnPoint& spawn : scene.spawn_points) {
        grid.seed(spawn.eye, frontier, stop);
    }
    grid.flood(std::move(frontier), progress, stop);
    if (stop.stop_requested()) return fail("interrupted", ErrorCode::interrupted);
    grid.summarise();
    return grid;
}

ReachedGrid::ReachedGrid(const Oracle& oracle, const Box3d& bounds, double pitch, double min_clearance)
    : oracle_(&oracle),
      bounds_(bounds),
      pitch_(pitch),
      min_clearance_(min_clearance),
      largest_coordinate_(std::max(bounds.min().cwiseAbs().maxCoeff(), bounds.max().cwiseAbs().maxCoeff())),
      sight_(sight_of(pitch, min_clearance)),
      near_(offsets_within(sight_ / pitch)) {}

bool ReachedGrid::reached(const Vec3d& point) const {
    return bounds_.contains(point) && reached(cell_of(point));
}

bool ReachedGrid::joined(const Vec3d& point) const {
    if (!joined_box_.contains(point) || oracle_->in_solid(point)) return false;
    if (!oracle_->end_clear(point, largest_coordinate_)) return false;
    const Cell own = cell_of(point);
    const auto sees = [&](const Cell& offset) {
        const Cell cell = own + offset;
        return reached(cell) && oracle_->between_clear(point, centre_of(cell));
    };
    const auto farther = near_.begin() + 27;  // after the cell and those around it
    return std::any_of(near_.begin(), farther, sees) ||
           (has_blocks_near(own) && std::any_of(farther, near_.end(), sees));
}

// Spares points far outside the search through all of near_.
bool ReachedGrid::has_blocks_near(const Cell& cell) const {
    const Cell reach = Cell::Constant(static_cast<int>(std::ceil(sight_ / pitch_)));
    const Cell low = Place(cell - reach).block;
    const Cell high = Place(cell + reach).block;
    for (int z = low.z(); z <= high.z(); ++z) {
        for (int y = low.y(); y <= high.y(); ++y) {
            for (int x = low.x(); x <= high.x(); ++x) {
                const auto found = blocks_.find(Cell(x, y, z));
                if (found != blocks_.end() && found->second.reached != Slices{}) return true;
            }
        }
    }
    return false;
}

ReachedGrid::Cell ReachedGrid::cell_of(const Vec3d& point) const {
    return ((point - bounds_.min()) / pitch_).array().floor().matrix().cast<int>();
}

Vec3d ReachedGrid::centre_of(const Cell& cell) const {
    return bounds_.min() + pitch_ * (cell.cast<double>() + Vec3d::Constant(0.5));
}

bool ReachedGrid::is_inside(const Cell& cell) const {
    return bounds_.contains(centre_of(cell));
}

bool ReachedGrid::reached(const Cell& cell) const {
    const Place place(cell);
    const auto found = blocks_.find(place.block);
    return found != blocks_.end() && (found->second.reached[place.slice] & place.bit) != 0;
}

ReachedGrid::Block& ReachedGrid::block_at(const Cell& block) {
    const auto [found, is_new] = blocks_.try_emplace(block);
    if (is_new) find_open(block * block_side, block_side, found->second.open);
    return found->second;
}

// Octree over the cells of a block: one query settles all cells of a node that is wholly open or closed.
void ReachedGrid::find_open(const Cell& first, int size, Slices& open) const {
    const Vec3d middle =
        bounds_.min() + pitch_ * (first.cast<double>() + Vec3d::Constant(static_cast<double>(size) / 2.0));
    // Of the sphere around the cells' centres.
    const double radius = pitch_ * (size - 1) / 2.0 * std::sqrt(3.0);
    const double clearance = oracle_->clearance(middle, radius + min_clearance_);
    const bool all_closed = clearance <= 0.0 ? clearance <= -radius : clearance <= min_clearance_ - radius;
    if (all_closed) return;
    const Cell last = first + Cell::Constant(size - 1);
    const bool all_open = size == 1 || (clearance > radius + min_clearance_ &&
                                        oracle_->ball_clear(middle, radius + min_clearance_));
    if (all_open && is_inside(first) && is_inside(last)) {
        const Place corner(first);
        const std::uint64_t row = ((std::uint64_t{1} << size) - 1) * corner.bit;
        for (std::size_t z = 0; z < static_cast<std::size_t>(size); ++z) {
            for (int y = 0; y < size; ++y) {
                open[corner.slice + z] |= row << (8 * y);
            }
        }
        return;
    }
    if (size == 1) return;
    const int half = size / 2;
    for (int child = 0; child < 8; ++child) {
        find_open(first + half * Cell(child & 1, child >> 1 & 1, child >> 2), half, open);
    }
}

void ReachedGrid::seed(const Vec3d& point, std::vector<Cell>& frontier, const std::stop_token& stop) {
    if (!bounds_.contains(point) || oracle_->in_solid(point) ||
        !oracle_->end_clear(point, largest_coordinate_))
        return;
    for (const Cell& offset : near_) {
        if (stop.stop_requested()) return;
        const Cell cell = cell_of(point) + offset;
        if (!is_inside(cell)) continue;
        const Place place(cell);
        Block& block = block_at(place.block);
        const std::uint64_t open = block.open[place.slice] & ~block.reached[place.slice];
        if ((open & place.bit) == 0 || !oracle_->between_clear(point, centre_of(cell))) continue;
        block.reached[place.slice] |= place.bit;
        frontier.push_back(place.block);
    }
}

void ReachedGrid::flood(std::vector<Cell> frontier, const ExploreProgress& progress,
                        const std::stop_token& stop) {
    constexpr std::uint64_t stride = 1024;
    for (std::uint64_t i = 0; !frontier.empty() && !stop.stop_requested(); ++i) {
        const Cell block = frontier.back();
        frontier.pop_back();
        spread(block, frontier);
        if (progress && i % stride == 0) progress(blocks_.size() * cells_of_a_block);
    }
}

// Fills the block from its reached cells, then hands on to the neighbours what touches them.
void ReachedGrid::spread(const Cell& block, std::vector<Cell>& frontier) {
    constexpr std::uint64_t first_column = 0x0101010101010101U;
    constexpr std::uint64_t last_column = first_column << 7U;
    Block& cells = block_at(block);
    Slices& reached = cells.reached;
    for (bool changed = true; changed;) {
        changed = false;
        for (std::size_t z = 0; z < block_side; ++z) {
            const std::uint64_t here = reached[z];
            std::uint64_t grown =
                here | here << 8U | here >> 8U | (here & ~last_column) << 1U | (here & ~first_column) >> 1U;
            if (z > 0) grown |= reached[z - 1];
            if (z + 1 < block_side) grown |= reached[z + 1];
            grown &= cells.open[z];
            changed = changed || grown != here;
            reached[z] = grown;
        }
    }

    Slices to_left{};
    Slices to_right{};
    Slices to_front{};
    Slices to_back{};
    for (std::size_t z = 0; z < block_side; ++z) {
        to_left[z] = (reached[z] & first_column) << 7U;
        to_right[z] = (reached[z] & last_column) >> 7U;
        to_front[z] = reached[z] << 56U;
        to_back[z] = reached[z] >> 56U;
    }
    const Slices down = {0, 0, 0, 0, 0, 0, 0, reached.front()};
    const Slices up = {reached.back()};
    const auto hand_on = [&](const Cell& direction, const Slices& arriving) {
        if (arriving == Slices{} || !is_inside((block + direction) * block_side)) return;
        Block& neighbour = block_at(block + direction);
        bool is_new = false;
        for (std::size_t z = 0; z < block_side; ++z) {
            const std::uint64_t added = arriving[z] & neighbour.open[z] & ~neighbour.reached[z];
            neighbour.reached[z] |= added;
            is_new = is_new || added != 0;
        }
        if (is_new) frontier.push_back(block + direction);
    };
    hand_on({-1, 0, 0}, to_left);
    hand_on({1, 0, 0}, to_right);
    hand_on({0, -1, 0}, to_front);
    hand_on({0, 1, 0}, to_back);
    hand_on({0, 0, -1}, down);
    hand_on({0, 0, 1}, up);
}

void ReachedGrid::summarise() {
    for (const auto& [block, cells] : blocks_) {
        for (int z = 0; z < block_side; ++z) {
            const std::uint64_t slice = cells.reached[static_cast<std::size_t>(z)];
            for (std::uint64_t rest = slice; rest != 0; rest &= rest - 1) {
                const int bit = std::countr_zero(rest);
                joined_box_.extend(centre_of(block * block_side + Cell(bit % 8, bit / 8, z)));
            }
            reached_count_ += static_cast<std::size_t>(std::popcount(slice));
        }
    }
    if (reached_count_ == 0) return;
    const Vec3d margin = Vec3d::Constant(sight_ + pitch_);
    joined_box_ = Box3d(joined_box_.min() - margin, joined_box_.max() + margin).intersection(bounds_);
}

}  // namespace camdir::oracle
